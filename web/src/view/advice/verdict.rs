//! The verdict on a result in one sentence, and the next action: for a failed global test the most likely cause, according to the
//! advice of the adjustment.

use leptos::prelude::*;
use sightline::adjustment::{Adjustment, Advice, Given};
use sightline::project::{Parameter, Project};

use super::{Item, Target, follow, of_the_input, step_of, systematic};
use crate::format;
use crate::i18n::{first, text};
use crate::store::{Desk, Step};
use crate::view::components::given::given_kind;
use crate::view::components::given::given_name;
use crate::view::components::icon::{Glyph, Icon};

/// Share of the image observations up to which suspected ones are taken for gross errors. Of sound observations one in five hundred
/// exceeds the limit; where all standard errors are 1.4 times too small, more than this share does.
const FEW: f64 = 0.03;

/// Most likely cause of a failed global test.
#[derive(Clone, Debug, PartialEq)]
enum FailureCause {
    /// Something given, by name: control, a distance, a unit, a camera.
    Given(String, Target),
    /// Systematic residuals: what they depend on, and the remedy.
    Systematic(String, Target),
    /// Single observations.
    GrossErrors { count: usize, point: String, photo: String },
    /// A camera whose distortion is neither known nor estimated.
    Model { camera: String },
    /// Image coordinates are less accurate than their standard errors: extra image error in pixels that would explain it.
    ImageSigma { unmodelled: Option<f64> },
    /// They are better than that.
    SigmaTooLarge,
}

/// Verdict on a result.
#[derive(Clone, Debug, PartialEq)]
enum Verdict {
    Passed {
        sigma0: f64,
    },
    Failed {
        sigma0: f64,
        cause: FailureCause,
    },
    /// No test fails, but the photos contradict something given, which was not used or bent the result within what the test lets pass.
    Contradicted(String, Target),
    /// Standard errors were estimated from the residuals: nothing independent tests them.
    Estimated,
    /// Nothing is checked by anything.
    NoRedundancy,
}

fn verdict(a: &Adjustment, project: &Project) -> Option<Verdict> {
    if a.redundancy == 0 {
        return Some(Verdict::NoRedundancy);
    }
    let untested = a.standard_errors_estimated();
    if (untested || a.global_test.as_ref().is_some_and(|test| test.passed))
        && let Some((words, target)) = contradiction(a)
    {
        return Some(Verdict::Contradicted(words, target));
    }
    if untested {
        return Some(Verdict::Estimated);
    }
    let (sigma0, test) = (a.sigma0?, a.global_test.as_ref()?);
    if test.passed {
        return Some(Verdict::Passed { sigma0 });
    }
    let cause = if test.statistic < test.lower { FailureCause::SigmaTooLarge } else { cause(a, project) };
    Some(Verdict::Failed { sigma0, cause })
}

/// A given value that contradicts the photos, and the place where it is shown.
fn contradiction(a: &Adjustment) -> Option<(String, Target)> {
    let of_control = |advice: &Advice| match advice {
        Advice::ControlMisfit { point, .. } => Some(first::cause_given(first::control_point(), point)),
        Advice::ExchangedPoints { points: [one, other] } => Some(text::exchanged_points(one, other)),
        _ => None,
    };
    if let Some(words) = a.advice.iter().find_map(of_control) {
        return Some((words, Target::Step(Step::Control)));
    }
    let advice = a.advice.iter().find(|advice| of_the_input(advice) && advice.contradicts())?;
    let Item { title, .. } = super::network_item(advice, &a.criteria, "");
    Some((title, Target::Step(Step::Adjust)))
}

/// Given values are examined first, since one wrong value affects everything; then the pattern of the residuals, single observations, the camera model, and
/// last the standard errors, which seem too small in all the other cases too.
fn cause(a: &Adjustment, project: &Project) -> FailureCause {
    if let Some((words, target)) = contradiction(a) {
        return FailureCause::Given(words, target);
    }
    if let Some(Item { title, target, .. }) = a.advice.iter().find_map(systematic::item) {
        return FailureCause::Systematic(title, target);
    }
    let used = a.observations.iter().filter(|o| o.enabled).count();
    let suspected = a.advice.iter().find_map(|advice| match advice {
        Advice::Suspected { count, observations, given } => Some((*count, observations, given)),
        _ => None,
    });
    let largest = |w: Option<f64>| w.map_or(0.0, f64::abs);
    if let Some((count, observations, given)) = suspected {
        let (image, other): (_, Option<&(Given, f64)>) = (observations.first(), given.first());
        let few = count as f64 <= (FEW * used as f64).max(1.0);
        match (image, other) {
            (_, Some((what, w))) if w.abs() >= largest(image.map(|o| o.2)) => {
                return FailureCause::Given(first::cause_given(given_kind(what), given_name(what)), step_of(what));
            }
            (Some((photo, point, _)), _) if few => {
                return FailureCause::GrossErrors { count, point: point.clone(), photo: photo.clone() };
            }
            _ => {}
        }
    }
    let of_photos = |id: &str| project.photos.iter().any(|photo| photo.enabled && photo.camera == id);
    let without_model = project.cameras.iter().find(|camera| {
        let estimated = camera.free.contains(&Parameter::K1) || camera.sigma.contains_key(&Parameter::K1);
        of_photos(&camera.id) && !estimated && camera.interior.get(Parameter::K1).is_none_or(|k1| k1 == 0.0)
    });
    if let Some(camera) = without_model {
        return FailureCause::Model { camera: camera.id.clone() };
    }
    let unmodelled = a.advice.iter().find_map(|advice| match advice {
        Advice::SigmasTooSmall { unmodelled, .. } => *unmodelled,
        Advice::UnmodelledAgain { unmodelled, .. } => Some(*unmodelled),
        _ => None,
    });
    FailureCause::ImageSigma { unmodelled }
}

impl Verdict {
    fn sentence(&self) -> String {
        match self {
            Self::Passed { sigma0 } => first::verdict_passed(format::fixed(*sigma0, 3)),
            Self::Contradicted(words, _) => first::verdict_contradicted(words),
            Self::Estimated => first::verdict_estimated().to_owned(),
            Self::NoRedundancy => first::verdict_no_redundancy().to_owned(),
            Self::Failed { sigma0, cause: FailureCause::SigmaTooLarge } => {
                first::verdict_too_large(format::fixed(*sigma0, 2))
            }
            Self::Failed { sigma0, cause } => {
                let words = match cause {
                    FailureCause::Given(words, _) | FailureCause::Systematic(words, _) => words.clone(),
                    FailureCause::GrossErrors { count, point, photo } => first::cause_gross_errors(count, point, photo),
                    FailureCause::Model { camera } => first::cause_model(camera),
                    FailureCause::ImageSigma { .. } | FailureCause::SigmaTooLarge => {
                        first::cause_image_sigma().to_owned()
                    }
                };
                first::verdict_failed(format::fixed(*sigma0, 2), words)
            }
        }
    }

    /// The next action: its words, and where it leads.
    fn action(&self) -> Option<(String, Target)> {
        let cause = match self {
            Self::Failed { cause, .. } => cause,
            Self::Contradicted(_, target) => return Some((text::show().to_owned(), target.clone())),
            _ => return None,
        };
        Some(match cause {
            FailureCause::Systematic(_, target) => (target.buttons().into_iter().next()?.0, target.clone()),
            FailureCause::Given(_, target) => (text::show().to_owned(), target.clone()),
            FailureCause::GrossErrors { point, photo, .. } => {
                (first::look_at_it().to_owned(), Target::Observation { photo: photo.clone(), point: point.clone() })
            }
            FailureCause::Model { .. } => (first::estimate_distortion().to_owned(), Target::Step(Step::Adjust)),
            FailureCause::ImageSigma { unmodelled: Some(px) } => {
                let target = super::unmodelled(*px);
                (target.buttons().into_iter().next()?.0, target)
            }
            FailureCause::ImageSigma { unmodelled: None } | FailureCause::SigmaTooLarge => {
                (first::change_weights().to_owned(), Target::Step(Step::Adjust))
            }
        })
    }
}

/// Beside the result, before any number: how good it is, and what to do next.
#[component]
pub fn VerdictLine() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let said = Memo::new(move |_| {
        desk.document.with(|d| d.current().and_then(|result| verdict(&result.adjustment, &result.input)))
    });
    let warnings = Memo::new(move |_| super::items(desk).iter().filter(|item| item.warning).count());
    move || {
        said.get().map(|verdict| {
            let failed = matches!(verdict, Verdict::Failed { .. } | Verdict::Contradicted(..) | Verdict::NoRedundancy);
            // What nothing tested has neither passed nor failed.
            let tested = verdict != Verdict::Estimated;
            let icon = tested.then_some(if failed { Icon::Warning } else { Icon::Check });
            let action = verdict.action().map(|(words, target)| {
                view! { <button class="button small" data-action="verdict" on:click=move |_| follow(desk, &target)>{words}</button> }
            });
            view! {
                <div class="verdict" class:failed=failed class:untested=!tested role="region" aria-label=first::verdict>
                    {icon.map(|icon| view! { <Glyph icon/> })}
                    <p data-verdict="">{verdict.sentence()}</p>
                    {action}
                    {move || (warnings.get() > 0).then(|| view! {
                        <button class="link" data-action="warnings" on:click=move |_| desk.go(Step::Adjust)>{first::warnings(warnings.get())}</button>
                    })}
                </div>
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use sightline::adjustment::AdjustedObservation;
    use sightline::project::{Camera, Interior, Photo};

    use super::*;

    fn project(free: &[Parameter]) -> Project {
        let camera = Camera { free: free.to_vec(), ..Camera::new("k", 4000, 3000, Interior::brown(5000.0)) };
        let photo = Photo { id: "a".into(), camera: "k".into(), enabled: true, ..Photo::default() };
        Project { cameras: vec![camera], photos: vec![photo].into(), ..Project::default() }
    }

    fn failed(advice: Vec<Advice>) -> Adjustment {
        let observation = AdjustedObservation { enabled: true, ..AdjustedObservation::default() };
        Adjustment { advice, observations: vec![observation; 400], ..Adjustment::default() }
    }

    #[test]
    fn a_failed_test_names_what_is_given_first_and_standard_errors_last() {
        let calibrated = project(&[Parameter::K1]);
        let suspected = |count: usize| Advice::Suspected {
            count,
            observations: vec![("a".into(), "7".into(), 5.0)],
            given: Vec::new(),
        };
        let small = || Advice::SigmasTooSmall { sigma0: 1.88, unmodelled: Some(0.05) };
        let misfit = || Advice::ControlMisfit { point: "9".into(), difference: [9.0, 0.0, 0.0], sigma_ratio: 30.0 };
        assert!(matches!(cause(&failed(vec![small(), suspected(2), misfit()]), &calibrated), FailureCause::Given(..)));
        let single = cause(&failed(vec![small(), suspected(2)]), &calibrated);
        assert_eq!(single, FailureCause::GrossErrors { count: 2, point: "7".into(), photo: "a".into() });
        // A test that passes does not make up for what is given wrong.
        let passed = sightline::adjustment::GlobalTest { passed: true, ..Default::default() };
        let sound =
            Adjustment { redundancy: 500, sigma0: Some(0.99), global_test: Some(passed), ..failed(vec![misfit()]) };
        assert!(matches!(verdict(&sound, &calibrated), Some(Verdict::Contradicted(..))));
        let sound = Adjustment { advice: vec![suspected(1)], ..sound };
        assert_eq!(verdict(&sound, &calibrated), Some(Verdict::Passed { sigma0: 0.99 }));
        // Where many are suspected it is none of them.
        let many = cause(&failed(vec![small(), suspected(60)]), &calibrated);
        assert_eq!(many, FailureCause::ImageSigma { unmodelled: Some(0.05) });
        assert_eq!(cause(&failed(vec![small()]), &project(&[])), FailureCause::Model { camera: "k".into() });
        // A test that fails by little has no advice of its own: a cause is named all the same.
        assert_eq!(cause(&failed(Vec::new()), &calibrated), FailureCause::ImageSigma { unmodelled: None });
        for cause in [single, many, FailureCause::Model { camera: "k".into() }, FailureCause::SigmaTooLarge] {
            assert!(Verdict::Failed { sigma0: 1.88, cause }.action().is_some());
        }
    }
}
