//! Poses that hardly anything bears out in the end are withdrawn.
//!
//! What is found wrong one after the other may leave a photo with a pose and next to no measurement. A measurement of a point that
//! two other photos or its given coordinates determine gives two equations of the pose, one of a point that one other photo shows
//! gives one. They must be as many as the six unknowns, and where other measurements of the photo disagree, some more: in 360 seeded
//! networks without given coordinates 45 of 49 photos with fewer were wrong. Four points of given coordinates orient a photo by
//! themselves, whatever a fifth says. Photos that were oriented at the end, against what stands and as the only pose that would
//! hardly come about by chance ([`by_chance`]), need no more than the unknowns.

use std::collections::HashMap;

use super::block::Block;
use crate::project::{DatumKind, Project, Role};

/// Unknowns of a pose, and equations beyond them that must agree where something disagrees.
pub(super) const UNKNOWNS: usize = 6;
const SPARE: usize = 4;
/// Points of given coordinates that are enough.
const KNOWN: usize = 4;

/// Part of the photo that the tolerance of an equation takes: 0.001 of its longer side, both ways, of a side two thirds as long.
const BAND: f64 = 3e-3;
/// Part of the photo that the circle of this tolerance takes around a point.
const CIRCLE: f64 = std::f64::consts::FRAC_PI_4 * BAND * BAND / 1.5;
/// Poses that the least number of measurements has: relative orientation from five points up to ten, resection from three up to four.
const SOLUTIONS: f64 = 10.0;
const OF_POINTS: f64 = 4.0;
/// Wrong poses that are accepted, on average, in place of a photo's own: few enough for projects of thousands of photos.
pub(super) const CHANCE: f64 = 1e-4;

/// Wrong poses that so many of a photo's measurements of points and of rays (epipolar lines) are expected to agree with by chance:
/// three points, or any six equations, have a few solutions, and each further measurement agrees with one of them as its
/// circle or band is to the photo; and that for every choice of the agreeing ones.
pub(super) fn by_chance(of: usize, points: usize, rays: usize) -> f64 {
    let agreeing = points + rays;
    let choices: f64 = (0..of - agreeing).map(|k| (of - k) as f64 / (k + 1) as f64).product();
    if points >= 3 {
        return OF_POINTS * choices * CIRCLE.powi(points as i32 - 3) * BAND.powi(rays as i32);
    }
    SOLUTIONS * choices * BAND.powi((2 * points + rays).saturating_sub(UNKNOWNS) as i32)
}

/// Takes back the poses of photos that too little agrees with, but for those that are `borne` out otherwise; whether there was one.
/// The project is what the block makes of it.
pub(super) fn withdraw(block: &mut Block, project: &Project, borne: &[bool]) -> bool {
    // of two photos the one stands by the other, and both by the points that meet; one that is left over stands by nothing
    if block.oriented() <= 2 {
        let alone = block.oriented() == 1 && !block.anchored;
        let left = block.views.iter_mut().find(|view| alone && view.pose.is_some() && !view.given);
        return left.is_some_and(|view| view.pose.take().is_some());
    }
    let photo_at: HashMap<&str, usize> = project.photos.iter().enumerate().map(|(k, p)| (p.id.as_str(), k)).collect();
    let point_at: HashMap<&str, usize> = project.points.iter().enumerate().map(|(k, p)| (p.id.as_str(), k)).collect();
    let posed: Vec<bool> = block.views.iter().map(|view| view.pose.is_some()).collect();
    let controlled = project.datum.kind == DatumKind::Control;
    let known: Vec<bool> = project
        .points
        .iter()
        .zip(&block.marks)
        .map(|(point, mark)| controlled && point.role == Role::Control || block.anchored && mark.known.is_some())
        .collect();
    // rays that agree, by point
    let mut rays = vec![0; project.points.len()];
    let mut taken = Vec::new();
    for observation in project.observations.iter().filter(|o| o.enabled) {
        let (photo, point) = (photo_at[observation.photo.as_str()], point_at[observation.point.as_str()]);
        if posed[photo] && project.points[point].xyz.is_some() {
            rays[point] += 1;
            taken.push((photo, point));
        }
    }
    let mut equations = vec![0; project.photos.len()];
    let mut given = vec![0; project.photos.len()];
    for (photo, point) in taken {
        given[photo] += usize::from(known[point]);
        equations[photo] += match rays[point] {
            _ if known[point] => 2,
            0 | 1 => 0,
            2 => 1,
            _ => 2,
        };
    }
    let mut disputed = vec![false; project.photos.len()];
    for aside in &project.set_aside {
        let (photo, point) = (photo_at[aside.photo.as_str()], point_at[aside.point.as_str()]);
        let shown = block.marks[point].sights.iter().filter(|&&s| posed[block.sights[s].photo]).count();
        disputed[photo] |= shown > 1 || known[point];
    }
    let enough = |photo: usize| UNKNOWNS + if disputed[photo] && !borne[photo] { SPARE } else { 0 };
    let borne_out = |photo: usize| given[photo] >= KNOWN || equations[photo] >= enough(photo);
    let weak = (0..block.views.len()).filter(|&k| posed[k] && !block.views[k].given && !borne_out(k));
    // those with the least go first: without them the others may stand
    let Some(least) = weak.clone().map(|k| equations[k]).min() else { return false };
    let withdrawn: Vec<usize> = weak.filter(|&k| equations[k] == least).collect();
    for &photo in &withdrawn {
        block.views[photo].pose = None;
    }
    // points that only they determined with others
    for point in 0..block.marks.len() {
        if block.marks[point].known.is_none() && block.rays(point).0.len() < 2 {
            block.marks[point].xyz = None;
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::initial::robust::{generator, uniform};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn what_agrees_by_chance_is_counted() {
        // Four of six rays beside a point: they fit some pose by themselves, and any four may be the ones.
        let stated = by_chance(7, 1, 4);
        assert!((stated / (SOLUTIONS * 21.0) - 1.0).abs() < 1e-12, "{stated}");
        // Simulated with wider bands: three of six decide a pose, any of the others agrees with a probability p.
        let (mut g, p, mut found) = (generator(1), 0.02, 0);
        let trials = 20_000;
        for _ in 0..trials {
            for _triple in 0..20 {
                found += usize::from((0..3).any(|_| uniform(&mut g) < p));
            }
        }
        let expected = found as f64 / f64::from(trials);
        let bound = by_chance(6, 4, 0) / (OF_POINTS * CIRCLE) * p * 4.0;
        assert!(expected <= bound && expected > 0.8 * bound, "{expected} of {bound}");
    }
}
