//! Points and their observations: naming, renaming and merging points, moving and removing measurements.

use std::collections::BTreeSet;

use sightline::project::{Observation, Point, Project, Role, Sigma};

use super::natural;

/// Standard error of a place that was set by hand, in pixels.
pub const BY_HAND_SIGMA: f64 = 0.5;

/// The observation of a target of a photo.
pub fn observation_of<'a>(project: &'a Project, photo: &str, target: u32) -> Option<&'a Observation> {
    project.observations.iter().find(|o| o.photo == photo && o.target == Some(target))
}

/// Photo and number of the target that an observation belongs to.
pub fn target_of(observation: &Observation) -> Option<(String, u32)> {
    observation.target.map(|target| (observation.photo.clone(), target))
}

/// Side effects of naming a position.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Naming {
    /// The point that the place belonged to before.
    pub before: Option<String>,
    /// Whether the point was measured at another place of the photo, which has no name now.
    pub elsewhere: bool,
}

/// Names a target or a place of a photo: a place has one name, and a point one place in a photo.
pub fn observe(project: &mut Project, observation: Observation) -> Naming {
    let mut naming = Naming::default();
    let at = observation.target;
    project.observations.retain(|o| {
        if o.photo != observation.photo {
            return true;
        }
        let (here, same) = (at.is_some() && o.target == at, o.point == observation.point);
        if here && !same {
            naming.before = Some(o.point.clone());
        }
        naming.elsewhere |= same && !here;
        !here && !same
    });
    project.observations.push(observation);
    tidy(project);
    naming
}

/// Moves an observation by pixels; its place is then by hand. False where there is none.
pub fn nudge(project: &mut Project, photo: &str, point: &str, step: [f64; 2]) -> bool {
    let Some(observation) = project.observations.iter_mut().find(|o| o.photo == photo && o.point == point) else {
        return false;
    };
    observation.u += step[0];
    observation.v += step[1];
    observation.sigma = Sigma::One(BY_HAND_SIGMA);
    observation.target = None;
    true
}

/// Takes an observation away; the target stays, without a name. A tie point goes with its last observation.
pub fn remove_observation(project: &mut Project, photo: &str, point: &str) {
    project.observations.retain(|o| o.photo != photo || o.point != point);
    tidy(project);
}

/// Lets an observation take part or not.
pub fn switch_observation(project: &mut Project, photo: &str, point: &str, enabled: bool) {
    for o in project.observations.iter_mut().filter(|o| o.photo == photo && o.point == point) {
        o.enabled = enabled;
    }
}

/// Lets an observation take part again that orientation or matching set aside: it is enabled, and no longer listed as set aside.
pub fn take_back(project: &mut Project, photo: &str, point: &str) {
    switch_observation(project, photo, point, true);
    project.set_aside.retain(|aside| aside.photo != photo || aside.point != point);
}

/// Photos that show both points: these cannot be one.
pub fn shared_photo(project: &Project, a: &str, b: &str) -> Option<String> {
    let photos = |id: &str| {
        let of = project.observations.iter().filter(|o| o.point == id);
        of.map(|o| o.photo.clone()).collect::<BTreeSet<_>>()
    };
    photos(a).intersection(&photos(b)).next().cloned()
}

/// Result of renaming a point.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Renamed {
    /// The point has the new name in so many photos.
    Alone { photos: usize },
    /// There was a point of that name: the two are one.
    Joined { photos: usize },
}

/// Gives a point another name, everywhere; an existing name joins the two.
///
/// # Errors
/// The photo that shows both, for two points seen there cannot be one.
pub fn rename(project: &mut Project, from: &str, to: &str) -> Result<Renamed, String> {
    if let Some(photo) = shared_photo(project, from, to).filter(|_| from != to) {
        return Err(photo);
    }
    for o in project.observations.iter_mut().filter(|o| o.point == from) {
        o.point = to.to_owned();
    }
    for d in &mut project.distances {
        for end in [&mut d.from, &mut d.to] {
            if *end == from {
                *end = to.to_owned();
            }
        }
    }
    project.rename_in_features(from, to);
    project.lines.retain(|line| line.from != line.to);
    // The two ends of a distance may have become one point.
    project.distances.retain(|d| d.from != d.to);
    if let Some(points) = &mut project.datum.points {
        for id in points.iter_mut().filter(|id| *id == from) {
            *id = to.to_owned();
        }
        let mut seen = BTreeSet::new();
        points.retain(|id| seen.insert(id.clone()));
    }
    let joined = from != to && project.points.iter().any(|p| p.id == to);
    if joined {
        let old = project.points.iter().find(|p| p.id == from).cloned();
        project.points.retain(|p| p.id != from);
        if let (Some(old), Some(kept)) = (old, project.points.iter_mut().find(|p| p.id == to)) {
            take_over(kept, old);
        }
    } else if let Some(point) = project.points.iter_mut().find(|p| p.id == from) {
        point.id = to.to_owned();
    }
    tidy(project);
    let photos = project.observations.iter().filter(|o| o.point == to).count();
    Ok(if joined { Renamed::Joined { photos } } else { Renamed::Alone { photos } })
}

/// Data of a merged point that the remaining point lacks.
fn take_over(kept: &mut Point, old: Point) {
    if kept.role == Role::Tie && old.role != Role::Tie {
        *kept = Point {
            id: kept.id.clone(),
            diameter: old.diameter.or(kept.diameter),
            normal: old.normal.or(kept.normal),
            ..old
        };
    } else {
        kept.xyz = kept.xyz.or(old.xyz);
        kept.diameter = kept.diameter.or(old.diameter);
        kept.normal = kept.normal.or(old.normal);
    }
}

/// Gives the observation of one photo to another point; see [`observe`].
pub fn rename_here(project: &mut Project, photo: &str, from: &str, to: &str) -> Naming {
    let Some(observation) = project.observations.iter().find(|o| o.photo == photo && o.point == from).cloned() else {
        return Naming::default();
    };
    observe(project, Observation { point: to.to_owned(), ..observation })
}

/// Takes a point out of the project with its observations and distances.
pub fn remove(project: &mut Project, id: &str) {
    project.observations.retain(|o| o.point != id);
    project.distances.retain(|d| d.from != id && d.to != id);
    project.lines.retain(|line| line.from != id && line.to != id);
    if let Some(points) = &mut project.datum.points {
        points.retain(|point| point != id);
    }
    project.points.retain(|p| p.id != id);
}

/// The first name from this one on that is not in use: its number at the end counts up.
pub fn next_free(project: &Project, name: &str) -> String {
    let used = project.points.iter().map(|p| p.id.as_str()).collect::<BTreeSet<_>>();
    let digits = name.len() - name.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    let (stem, number) = name.split_at(name.len() - digits);
    let mut next = number.parse::<u64>().unwrap_or(0);
    let mut candidate = name.to_owned();
    while candidate.is_empty() || used.contains(candidate.as_str()) {
        next = next.saturating_add(1);
        candidate = format!("{stem}{next:0digits$}");
        if next == u64::MAX {
            return free_name(project);
        }
    }
    candidate
}

/// A point name that is not in use, apart from the numbers of coded targets.
pub fn free_name(project: &Project) -> String {
    let largest = project.points.iter().filter_map(|p| p.id.parse::<u64>().ok()).max().unwrap_or(0);
    (largest.max(9000).saturating_add(1)).to_string()
}

/// Every observed point is in the list; tie points that nothing observes and nothing names are not.
pub fn tidy(project: &mut Project) {
    let observed = project.observations.iter().map(|o| o.point.as_str()).collect::<BTreeSet<_>>();
    let in_distance = |id: &str| project.distances.iter().any(|d| d.from == id || d.to == id);
    let keep = |p: &Point| p.role != Role::Tie || observed.contains(p.id.as_str()) || in_distance(&p.id);
    let mut points = project.points.iter().filter(|p| keep(p)).cloned().collect::<Vec<_>>();
    let known = points.iter().map(|p| p.id.clone()).collect::<BTreeSet<_>>();
    let new =
        observed.iter().filter(|id| !known.contains(**id)).map(|id| Point { id: (*id).to_owned(), ..Point::default() });
    let mut new = new.collect::<Vec<_>>();
    new.sort_by(|a, b| natural(&a.id, &b.id));
    points.extend(new);
    project.points = points.into();
}

#[cfg(test)]
mod tests {
    use sightline::project::{Datum, DatumKind, Distance};

    use super::*;

    fn seen(photo: &str, point: &str, u: f64) -> Observation {
        Observation {
            photo: photo.into(),
            point: point.into(),
            u,
            v: 5.0,
            sigma: Sigma::Two([0.01, 0.02]),
            enabled: true,
            target: Some(u as u32),
        }
    }

    /// Points 11 and 12 in photos 1 and 2, point 13 in photo 3.
    fn project() -> Project {
        let mut project = Project {
            observations: vec![
                seen("1", "11", 10.0),
                seen("1", "12", 20.0),
                seen("2", "11", 30.0),
                seen("2", "12", 40.0),
                seen("3", "13", 50.0),
            ]
            .into(),
            ..Project::default()
        };
        tidy(&mut project);
        project
    }

    fn ids(project: &Project) -> Vec<&str> {
        project.points.iter().map(|p| p.id.as_str()).collect()
    }

    #[test]
    fn naming_a_place_says_whose_it_was_and_that_the_point_was_elsewhere() {
        let mut p = project();
        let naming = observe(&mut p, seen("1", "12", 10.0));
        assert_eq!(naming, Naming { before: Some("11".into()), elsewhere: true });
        assert_eq!(p.observations.iter().filter(|o| o.photo == "1").count(), 1);
        assert_eq!(observation_of(&p, "1", 10).map(|o| o.point.as_str()), Some("12"));
        assert!(observation_of(&p, "2", 10).is_none());
        assert_eq!(observe(&mut p, seen("4", "20", 1.0)), Naming::default());
        assert_eq!(ids(&p), ["11", "12", "13", "20"]);
    }

    #[test]
    fn a_point_is_renamed_everywhere_or_in_one_photo() {
        let mut p = project();
        p.distances.push(Distance { from: "11".into(), to: "12".into(), length: 1.0, sigma: 0.1, check: false });
        p.datum = Datum { kind: DatumKind::Free, points: Some(vec!["11".into()]) };
        assert_eq!(rename(&mut p, "11", "A"), Ok(Renamed::Alone { photos: 2 }));
        assert_eq!((p.distances[0].from.as_str(), p.datum.points.as_deref()), ("A", Some(&["A".to_owned()][..])));
        assert_eq!(rename_here(&mut p, "1", "A", "B"), Naming { before: Some("A".into()), elsewhere: false });
        let of = |id: &str| p.observations.iter().filter(|o| o.point == id).count();
        assert_eq!((of("A"), of("B")), (1, 1));
    }

    #[test]
    fn points_are_joined_with_what_they_know_unless_a_photo_shows_both() {
        let mut p = project();
        let before = p.clone();
        assert_eq!(rename(&mut p, "11", "12"), Err("1".into()));
        assert_eq!(p, before);
        p.points[2] = Point { id: "13".into(), role: Role::Control, xyz: Some([1.0, 2.0, 3.0]), ..Point::default() };
        p.distances.push(Distance { from: "11".into(), to: "13".into(), length: 1.0, sigma: 0.1, check: false });
        assert_eq!(rename(&mut p, "13", "11"), Ok(Renamed::Joined { photos: 3 }));
        assert_eq!(ids(&p), ["11", "12"]);
        assert_eq!((p.points[0].role, p.points[0].xyz), (Role::Control, Some([1.0, 2.0, 3.0])));
        assert!(p.distances.is_empty());
    }

    #[test]
    fn a_tie_point_goes_with_its_last_observation_and_control_stays() {
        let mut p = project();
        remove_observation(&mut p, "3", "13");
        assert_eq!(ids(&p), ["11", "12"]);
        p.points[0].role = Role::Control;
        for photo in ["1", "2"] {
            remove_observation(&mut p, photo, "11");
        }
        assert_eq!(ids(&p), ["11", "12"]);
        remove(&mut p, "11");
        assert_eq!(ids(&p), ["12"]);
    }

    #[test]
    fn a_moved_observation_is_by_hand() {
        let mut p = project();
        assert!(nudge(&mut p, "1", "11", [0.5, -1.0]));
        assert_eq!((p.observations[0].u, p.observations[0].v), (10.5, 4.0));
        assert_eq!(p.observations[0].sigma, Sigma::One(BY_HAND_SIGMA));
        assert!(!nudge(&mut p, "9", "11", [0.5, -1.0]));
        switch_observation(&mut p, "1", "11", false);
        assert!(!p.observations[0].enabled && p.observations[2].enabled);
    }

    #[test]
    fn names_of_a_series_count_up_and_keep_their_form() {
        let p = project();
        assert_eq!(next_free(&p, "A"), "A");
        assert_eq!(next_free(&p, "11"), "14");
        let mut p = p;
        p.points.extend(["A", "P07", "P08"].map(|id| Point { id: id.into(), ..Point::default() }));
        assert_eq!((next_free(&p, "A"), next_free(&p, "P07")), ("A1".into(), "P09".into()));
        p.points.push(Point { id: u64::MAX.to_string(), ..Point::default() });
        assert!(!next_free(&p, &u64::MAX.to_string()).is_empty());
    }

    #[test]
    fn free_names_do_not_collide() {
        let mut p = project();
        assert_eq!(free_name(&p), "9001");
        p.points.push(Point { id: "9400".into(), ..Point::default() });
        assert_eq!(free_name(&p), "9401");
        p.points.push(Point { id: u64::MAX.to_string(), ..Point::default() });
        assert!(!free_name(&p).is_empty());
    }
}
