//! Alternates matching and adjustment until nothing is added.
//!
//! What is matched improves the orientations, and better orientations show more. Photos of few names first find their pose by the
//! targets of points that there are ([`super::poses`]); what is found is joined to points that there are ([`super::join`]), so
//! that one target does not become two points because two groups of photos saw it from poses that did not fit yet.

use std::collections::{BTreeMap, BTreeSet};

use super::free::{MatchOptions, Matching};
use super::gross::disagreeing;
use super::uncoded::one_round;
use super::{Doubt, Doubtful, PhotoTargets, join, poses, size};
use crate::adjust::{adjust, apply};
use crate::adjustment::{AdjustOptions, StatisticsChoice, Termination};
use crate::error::Result;
use crate::project::{Observation, Project, Role};

/// Turns; the search ends when nothing more is found, this only bounds its time.
const MOST_ROUNDS: usize = 8;

/// A name given to a target: photo, point and place, which is as it was measured.
type Naming = (String, String, [u64; 2]);

fn naming(o: &Observation) -> Naming {
    (o.photo.clone(), o.point.clone(), [o.u.to_bits(), o.v.to_bits()])
}

/// Names targets of oriented photos that have no name yet.
///
/// `project` is oriented (better: adjusted) and holds the observations named so far; `targets` are all detected ones.
/// Targets where the project has a control point that no photo names yet are that point, as soon as three control points are named and seen in
/// their places. New points are called "u1", "u2" … as far as these identifiers are free; they have the diameter that their images show
/// where the project fixes the scale. Matching and adjusting take turns until nothing more is
/// found ([`settled`]); the project is left as it is.
///
/// # Errors
/// Those of [`Project::validate`]. Photos without orientation, and targets of photos that do not exist, are skipped.
pub fn match_uncoded(project: &Project, targets: &[PhotoTargets], options: &MatchOptions) -> Result<Matching> {
    project.validate()?;
    Ok(settled(project, targets, options))
}

/// Everything that is found in turns. The document is valid.
fn settled(project: &Project, targets: &[PhotoTargets], options: &MatchOptions) -> Matching {
    let mut current = project.clone();
    let mut all = Matching::default();
    let mut refused: BTreeSet<Naming> = BTreeSet::new();
    let mut contradicted = Vec::new();
    for _ in 0..MOST_ROUNDS {
        poses::from_targets(&mut current, targets, options);
        let mut found = one_round(&current, targets, options);
        found.observations.retain(|o| !refused.contains(&naming(o)));
        drop_short(&mut found);
        all.doubtful = found.doubtful;
        if found.observations.is_empty() {
            break;
        }
        current.points.extend(found.points.iter().cloned());
        current.observations.extend(found.observations.iter().cloned());
        all.points.extend(found.points);
        all.observations.extend(found.observations);
        let Some(adjusted) = adjusted(&current) else { break };
        current = adjusted;
        let own: BTreeSet<Naming> = all.observations.iter().map(naming).collect();
        let wrong: Vec<Naming> =
            disagreeing(&current).into_iter().map(|row| naming(&current.observations[row])).collect();
        for naming in wrong.into_iter().filter(|naming| own.contains(naming)) {
            let same = |o: &Observation| self::naming(o) == naming;
            if let Some(o) = all.observations.iter().find(|o| same(o)) {
                contradicted.push(Doubtful {
                    photo: o.photo.clone(),
                    u: o.u,
                    v: o.v,
                    target: o.target,
                    points: vec![o.point.clone()],
                    reason: Doubt::Disagrees,
                });
            }
            current.observations.retain(|o| !same(o));
            all.observations.retain(|o| !same(o));
            refused.insert(naming);
        }
        join::join(&mut current, &mut all, targets, options);
        drop_short(&mut all);
        let kept: BTreeSet<&str> = project.points.iter().chain(&all.points).map(|p| p.id.as_str()).collect();
        current.points.retain(|point| kept.contains(point.id.as_str()));
        current.observations.retain(|o| kept.contains(o.point.as_str()));
    }
    let places: BTreeMap<&str, Option<[f64; 3]>> = current.points.iter().map(|p| (p.id.as_str(), p.xyz)).collect();
    for point in &mut all.points {
        point.xyz = places.get(point.id.as_str()).copied().flatten().or(point.xyz);
    }
    size::measure(&current, targets, &mut all);
    let named: BTreeSet<(&str, [u64; 2])> =
        all.observations.iter().map(|o| (o.photo.as_str(), [o.u.to_bits(), o.v.to_bits()])).collect();
    let open = |d: &Doubtful| !named.contains(&(d.photo.as_str(), [d.u.to_bits(), d.v.to_bits()]));
    let listed: BTreeSet<(String, [u64; 2])> =
        all.doubtful.iter().map(|d| (d.photo.clone(), [d.u.to_bits(), d.v.to_bits()])).collect();
    contradicted.retain(|d| open(d) && !listed.contains(&(d.photo.clone(), [d.u.to_bits(), d.v.to_bits()])));
    all.doubtful.extend(contradicted);
    all
}

/// Takes new points of a single ray out.
fn drop_short(matching: &mut Matching) {
    let mut rays: BTreeMap<&str, usize> = BTreeMap::new();
    matching.observations.iter().for_each(|o| *rays.entry(&o.point).or_default() += 1);
    let short: BTreeSet<String> = matching
        .points
        .iter()
        .filter(|point| rays.get(point.id.as_str()).is_none_or(|n| *n < 2))
        .map(|point| point.id.clone())
        .collect();
    matching.points.retain(|point| !short.contains(&point.id));
    matching.observations.retain(|o| !short.contains(&o.point));
}

/// The document with adjusted values, of what can be adjusted of it; `None` if that cannot.
fn adjusted(project: &Project) -> Option<Project> {
    let mut part = project.clone();
    let posed = |p: &crate::project::Photo| p.enabled && p.position.is_some() && p.rotation.is_some();
    let photos: BTreeSet<String> = part.photos.iter().filter(|p| posed(p)).map(|p| p.id.clone()).collect();
    let placed: BTreeSet<String> = part.points.iter().filter(|p| p.xyz.is_some()).map(|p| p.id.clone()).collect();
    part.observations.retain(|o| o.enabled && photos.contains(&o.photo) && placed.contains(&o.point));
    let mut rays: BTreeMap<String, usize> = BTreeMap::new();
    part.observations.iter().for_each(|o| *rays.entry(o.point.clone()).or_default() += 1);
    let few = |id: &str| rays.get(id).is_none_or(|n| *n < 2);
    part.points.retain(|p| p.role != Role::Tie || !few(&p.id));
    let left: BTreeSet<String> = part.points.iter().map(|p| p.id.clone()).collect();
    part.observations.retain(|o| left.contains(&o.point));
    part.distances.retain(|d| left.contains(&d.from) && left.contains(&d.to));
    part.set_aside.clear();
    (part.features, part.systems, part.lines, part.plan) = Default::default();
    if let Some(points) = &mut part.datum.points {
        points.retain(|id| left.contains(id));
    }
    let options = AdjustOptions { statistics: StatisticsChoice::None, ..AdjustOptions::default() };
    let adjustment = adjust(&part, &options, &mut |_| true).ok()?;
    (adjustment.termination == Termination::Converged).then(|| {
        // Rows of the part are not those of the document.
        let values = crate::adjustment::Adjustment { observations: Vec::new(), ..adjustment };
        apply(project, &values)
    })
}
