//! The adjustment laid open. The last one is kept with its steps, so that the next step is one step and not all of them.

use std::cell::RefCell;

use sightline::Result;
use sightline::adjust::{Adjuster, FillIn, NormalEquations, StepState, start_adjustment};
use sightline::project::Project;
use sightline_exchange::package::archive;
use sightline_lab::teaching;
use sightline_protocol::{
    ExportInside, Found, Given, Inquire, Inquiry, InsideOf, LookInside, Looked, Nothing, Places, Progress, Served,
    Service, factor_bytes, matrices,
};

use crate::Engine;
use crate::tasks::with_what_is_oriented;

thread_local! {
    static KEPT: RefCell<Option<Kept>> = const { RefCell::new(None) };
}

struct Kept {
    /// Which network, as the page counts them.
    serial: usize,
    adjuster: Adjuster,
    /// What the page has of the first step.
    known: Option<Known>,
}

/// What follows from the places of the entries alone.
struct Known {
    places: Places,
    fill_in: FillIn,
    elimination_order: Vec<usize>,
}

/// Works with the adjustment of a network.
fn with_kept<T>(of: &InsideOf, work: impl FnOnce(&mut Kept) -> Result<T>) -> Result<T> {
    KEPT.with_borrow_mut(|kept| {
        let mut found = match kept.take_if(|kept| kept.serial == of.serial) {
            Some(found) => found,
            None => {
                let adjuster = start_adjustment(&project(of)?, &of.options)?;
                Kept { serial: of.serial, adjuster, known: None }
            }
        };
        let worked = work(&mut found);
        *kept = Some(found);
        worked
    })
}

/// Goes to so many steps, or to the last one.
fn go(adjuster: &mut Adjuster, step: usize) -> Result<()> {
    while adjuster.state().step > step {
        adjuster.back();
    }
    while adjuster.state().step < step && adjuster.state().termination.is_none() {
        adjuster.step()?;
    }
    Ok(())
}

/// Works at the values after so many steps.
fn at_step<T>(of: &InsideOf, step: usize, work: impl FnOnce(&Adjuster) -> Result<T>) -> Result<T> {
    with_kept(of, |Kept { adjuster, .. }| {
        go(adjuster, step)?;
        work(adjuster)
    })
}

fn project(of: &InsideOf) -> Result<Project> {
    let project = match &of.project {
        Some(project) => with_what_is_oriented(project, &mut |_| {})?,
        None => teaching::lab()?,
    };
    Ok(teaching::moved(&project, of.moved))
}

impl Service<LookInside> for Engine {
    fn serve(&self, task: LookInside, _: Vec<Given>, _: Progress<Nothing>) -> Served<Looked> {
        let LookInside { of, step, names } = task;
        with_kept(&of, |Kept { adjuster, known, .. }| {
            let (system, normal) = if names {
                go(adjuster, step)?;
                adjuster.equations()?
            } else {
                go(adjuster, step.saturating_sub(1))?;
                adjuster.step_with_numbers()?
            };
            let mut looked = Looked { state: without_project(adjuster.state()), system, normal, observed: Vec::new() };
            if names {
                let NormalEquations { fill_in, elimination_order, .. } = &looked.normal;
                let (fill_in, elimination_order) = (*fill_in, elimination_order.clone());
                *known = Some(Known { places: Places::of(&looked), fill_in, elimination_order });
                let bytes = matrices(&mut looked, true, None);
                return Ok((looked, bytes));
            }
            looked.normal.fill_in = match known {
                Some(known) if known.places.has_normal(&looked.normal.n) => known.fill_in,
                _ => adjuster.normal_equations()?.fill_in,
            };
            let bytes = matrices(&mut looked, false, known.as_ref().map(|known| &known.places));
            Ok((looked, bytes))
        })
    }
}

/// The page shows values, and needs no second document.
fn without_project(state: &StepState) -> StepState {
    StepState {
        step: state.step,
        project: Project::default(),
        iteration: state.iteration.clone(),
        weighted_squares: state.weighted_squares,
        sigma0: state.sigma0,
        values: state.values.clone(),
        corrections: state.corrections.clone(),
        residuals: state.residuals.clone(),
        termination: state.termination,
    }
}

impl Service<Inquire> for Engine {
    fn serve(&self, task: Inquire, _: Vec<Given>, _: Progress<Nothing>) -> Served<Found> {
        let Inquire { of, inquiry } = task;
        let options = &of.options;
        let found = match inquiry {
            Inquiry::Row { step, row } => Found::Row(at_step(&of, step, |at| teaching::explain(at, options, row))?),
            Inquiry::Sigmas(step) => Found::Sigmas(at_step(&of, step, teaching::sigmas)?),
            Inquiry::Factor { step, elimination } => {
                let normal = with_kept(&of, |Kept { adjuster, known, .. }| {
                    go(adjuster, step)?;
                    let Some(known) = known else { return adjuster.normal_equations() };
                    let (_, normal) = adjuster.numbers()?;
                    Ok(NormalEquations { elimination_order: known.elimination_order.clone(), ..normal })
                })?;
                let factor = normal.cholesky_factor(elimination);
                return Ok(match factor {
                    Some(mut factor) => {
                        let bytes = factor_bytes(&mut factor);
                        (Found::Factor(Some(factor)), bytes)
                    }
                    None => (Found::Factor(None), Vec::new()),
                });
            }
            Inquiry::Datums(held) => Found::Datums(teaching::datums(&project(&of)?, options, held.as_deref())?),
            Inquiry::Transform(datums, held) => {
                Found::Transform(teaching::transformed(&project(&of)?, options, held.as_deref(), datums)?)
            }
            Inquiry::Plant(errors) => Found::Plant(teaching::plant(&project(&of)?, options, &errors)?),
            Inquiry::Weigh(image, control) => {
                Found::Weigh(teaching::weighted(&project(&of)?, options, image, control)?)
            }
            Inquiry::Biases(diameters) => Found::Biases(teaching::biases(&project(&of)?, options, &diameters)?),
            Inquiry::Lessons => Found::Lessons(teaching::lessons()),
            Inquiry::ReadLesson(text) => Found::ReadLesson(Box::new(teaching::Lesson::read(&text))),
            Inquiry::Evaluate(texts) => Found::Evaluate(teaching::evaluate(&project(&of)?, options, &texts)?),
        };
        Ok((found, Vec::new()))
    }
}

impl Service<ExportInside> for Engine {
    fn serve(&self, task: ExportInside, _: Vec<Given>, _: Progress<Nothing>) -> Served<()> {
        let files = teaching::files(&project(&task.of)?, &task.of.options)?;
        Ok(((), vec![archive(&files)?]))
    }
}
