//! The adjustment laid open. The last one is kept with its steps, so that the next step is one step and not all of them.

use std::cell::RefCell;

use sightline::adjust::{Adjuster, start_adjustment};
use sightline::exchange::package::archive;
use sightline::project::Project;
use sightline::{Result, teaching};
use sightline_protocol::{
    ExportInside, Found, Given, Inquire, Inquiry, InsideOf, LookInside, Looked, Nothing, Progress, Served, Service,
    matrices, to_bytes,
};

use crate::kept::digest;
use crate::tasks::{Engine, with_what_is_oriented};

thread_local! {
    static KEPT: RefCell<Option<(u64, Adjuster)>> = const { RefCell::new(None) };
}

/// Works at the values after so many steps.
fn at_step<T>(of: &InsideOf, step: usize, work: impl FnOnce(&Adjuster) -> Result<T>) -> Result<T> {
    let key = digest(&to_bytes(of));
    KEPT.with_borrow_mut(|kept| {
        if kept.as_ref().is_none_or(|(known, _)| *known != key) {
            *kept = Some((key, start_adjustment(&project(of)?, &of.options)?));
        }
        let Some((_, adjuster)) = kept else { return work(&start_adjustment(&project(of)?, &of.options)?) };
        while adjuster.state().step > step {
            adjuster.back();
        }
        while adjuster.state().step < step && adjuster.state().termination.is_none() {
            adjuster.step()?;
        }
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
        let mut looked = at_step(&task.of, task.step, |adjuster| {
            let (system, normal) = (adjuster.linear_system()?, adjuster.normal_equations()?);
            Ok(Looked { state: adjuster.state().clone(), system, normal })
        })?;
        let bytes = matrices(&mut looked);
        // The page shows values, and needs no second document.
        looked.state.project = Project::default();
        Ok((looked, bytes))
    }
}

impl Service<Inquire> for Engine {
    fn serve(&self, task: Inquire, _: Vec<Given>, _: Progress<Nothing>) -> Served<Found> {
        let Inquire { of, inquiry } = task;
        let options = &of.options;
        let found = match inquiry {
            Inquiry::Row { step, row } => Found::Row(at_step(&of, step, |at| teaching::explain(at, options, row))?),
            Inquiry::Datums(held) => Found::Datums(teaching::datums(&project(&of)?, options, held.as_deref())?),
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
