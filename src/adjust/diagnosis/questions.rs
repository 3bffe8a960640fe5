//! Plausibility checks of the input in an adjustment: [`crate::plausibility`] with the document's and the adjusted values.

use std::collections::HashMap;

use crate::adjustment::{Adjustment, Advice, OneStation};
use crate::error::{Defect, Error};
use crate::initial::Pose;
use crate::plausibility::axes::{self, PointPair, Question};
use crate::plausibility::{cameras, one_station, scale, units};
use crate::project::{DatumKind, Photo, Project, Role};

/// Rays that a point needs to have a place of its own.
const RAYS: usize = 2;
/// Given points that orient a photo without any parallax.
const KNOWN: usize = 3;

/// Photos that were all taken from one place show no depth, and whatever came out of them would be noise. Control points orient them all
/// the same, and their cameras are determined.
pub fn one_place(project: &Project) -> Option<Error> {
    let given = |role: Role| role == Role::Control && project.datum.kind == DatumKind::Control;
    if project.points.iter().filter(|p| given(p.role) && p.xyz.is_some()).count() >= KNOWN {
        return None;
    }
    let OneStation { photos, .. } = one_station::is_all(project)?;
    Some(Error::RankDefect { defects: vec![Defect::OneStation { photos }] })
}

/// Questions about the input, the most serious first; `distances` is the number of distances that are used.
pub fn questions(project: &Project, distances: usize, adjustment: &Adjustment) -> Vec<Advice> {
    // Cameras and orientations as the network determines them.
    let adjusted = crate::adjust::apply(project, adjustment);
    let mut advice: Vec<Advice> = units::of_lengths(project).into_iter().map(Advice::UnitRatio).collect();
    advice.extend(axes(project, adjustment).map(|question| match question {
        Question::Mirrored(mirrored) => Advice::MirroredControl(mirrored),
        Question::Undecided(undecided) => Advice::UndecidedAxes(undecided),
    }));
    advice.extend(one_station::groups(&adjusted).into_iter().map(Advice::OneStation));
    advice.extend(cameras::implausible(project).into_iter().map(Advice::ImplausibleCamera));
    advice.extend((!scale::is_given(project, distances)).then_some(Advice::NoScale));
    advice
}

/// Whether it concerns all given values rather than single items.
pub fn is_cause(advice: &Advice) -> bool {
    matches!(advice, Advice::MirroredControl(_) | Advice::UndecidedAxes(_) | Advice::UnitRatio(_))
}

/// Whether it means that a given value distorts the fit of the photos, so that their residuals are systematic for that reason.
pub fn bends(advice: &Advice) -> bool {
    is_cause(advice) || matches!(advice, Advice::ControlMisfit { .. } | Advice::ExchangedPoints { .. })
}

/// Given coordinates against the adjusted ones. Those of control points are drawn towards what is given: where they lie in a plane the form
/// is the photos' own all the same, and check points are free.
fn axes(project: &Project, adjustment: &Adjustment) -> Option<Question> {
    let rms = |sigma: [f64; 3]| (sigma.iter().map(|s| s * s).sum::<f64>() / 3.0).sqrt();
    let of_given = |sigma: Option<[Option<f64>; 3]>| sigma.map_or(0.0, |s| rms(s.map(Option::unwrap_or_default)));
    let given: HashMap<&str, _> =
        project.points.iter().filter(|p| p.role != Role::Tie).map(|p| (p.id.as_str(), p)).collect();
    let mut pairs: Vec<PointPair> = Vec::new();
    for point in adjustment.points.iter().filter(|p| p.rays >= RAYS) {
        let Some((xyz, sigma)) = given.get(point.id.as_str()).and_then(|p| Some((p.xyz?, p.sigma))) else { continue };
        let free_sigma = point.sigma.map_or(0.0, rms);
        pairs.push(PointPair { free: point.xyz.into(), given: xyz.into(), free_sigma, given_sigma: of_given(sigma) });
    }
    let pose = |p: &crate::adjustment::AdjustedPhoto| {
        let (position, rotation) = (Some(p.position), Some(p.rotation));
        Pose::of_photo(&Photo { position, rotation, ..Photo::default() })
    };
    let poses: Vec<Pose> = adjustment.photos.iter().filter_map(pose).collect();
    axes::question(&pairs, &poses)
}
