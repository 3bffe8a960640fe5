//! Control: given coordinates, measured distances, unit and datum.

use sightline::Error;
pub use sightline::equipment::has_lengths;
use sightline::project::{DatumKind, Distance, Point, Project, Role};
pub use sightline::units::Unit;
use sightline::units::factor;

/// Takes points as control, or as what they say they are, in place of what was known of them. Their coordinates come in
/// `unit`: the first ones give the project its unit, later ones are converted to it. How many.
///
/// # Errors
/// For coordinates that cannot be converted, as from or to an unknown unit; then nothing is taken.
pub fn take_points(project: &mut Project, points: Vec<Point>, unit: &str) -> Result<usize, Error> {
    let fresh = !has_lengths(project);
    let factor = if fresh { 1.0 } else { factor(unit, &project.unit)? };
    let points = Project { points: points.into(), ..Project::default() }.scaled(factor)?.points;
    if fresh {
        project.unit = unit.to_owned();
    }
    let count = points.len();
    for point in points {
        let role = if point.role == Role::Tie { Role::Control } else { point.role };
        let point = Point { role, ..point };
        match project.points.iter_mut().find(|p| p.id == point.id) {
            Some(known) => {
                let diameter = point.diameter.or(known.diameter);
                let normal = point.normal.or(known.normal);
                *known = Point { diameter, normal, ..point };
            }
            None => project.points.push(point),
        }
    }
    // Three points fix a system: the control system is then what people expect to stand in.
    let control = project.points.iter().filter(|p| p.role == Role::Control).count();
    if control >= 3 && project.datum.kind == DatumKind::Free && project.datum.points.is_none() {
        project.datum.kind = DatumKind::Control;
    }
    Ok(count)
}

/// Takes approximate coordinates: of tie points, new or known; a point with given coordinates keeps them. Units as in [`take_points`]. How many.
///
/// # Errors
/// As [`take_points`].
pub fn take_approximate(project: &mut Project, points: Vec<Point>, unit: &str) -> Result<usize, Error> {
    let fresh = !has_lengths(project);
    let factor = if fresh { 1.0 } else { factor(unit, &project.unit)? };
    let points = Project { points: points.into(), ..Project::default() }.scaled(factor)?.points;
    if fresh {
        project.unit = unit.to_owned();
    }
    let mut count = 0;
    for point in points {
        match project.points.iter_mut().find(|p| p.id == point.id) {
            Some(known) if known.role != Role::Tie => continue,
            Some(known) => {
                known.xyz = point.xyz;
                known.diameter = point.diameter.or(known.diameter);
            }
            None => project.points.push(Point { role: Role::Tie, sigma: None, ..point }),
        }
        count += 1;
    }
    Ok(count)
}

/// Gives a point a role; a tie point is kept only as long as something observes it.
pub fn set_role(project: &mut Project, id: &str, role: Role) {
    if let Some(point) = project.points.iter_mut().find(|p| p.id == id) {
        point.role = role;
    }
}

/// Gives a point one of its coordinates.
pub fn set_coordinate(project: &mut Project, id: &str, axis: usize, value: f64) {
    if let Some(point) = project.points.iter_mut().find(|p| p.id == id) {
        point.xyz.get_or_insert_default()[axis] = value;
    }
}

/// Gives one of a point's coordinates a standard error; none fixes a control point there.
pub fn set_sigma(project: &mut Project, id: &str, axis: usize, sigma: Option<f64>) {
    if let Some(point) = project.points.iter_mut().find(|p| p.id == id) {
        point.sigma.get_or_insert_default()[axis] = sigma;
        if point.sigma == Some([None; 3]) {
            point.sigma = None;
        }
    }
}

/// What a distance lacks before it can be taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DistanceFault {
    SamePoint,
    NoSuchPoint,
    Length,
    Sigma,
    /// A comma before three digits can be read in two ways.
    Ambiguous,
}

/// Adds a measured distance.
///
/// # Errors
/// What it lacks.
pub fn add_distance(project: &mut Project, distance: Distance) -> Result<(), DistanceFault> {
    let known = |id: &str| project.points.iter().any(|p| p.id == id);
    if !known(&distance.from) || !known(&distance.to) {
        return Err(DistanceFault::NoSuchPoint);
    }
    if distance.from == distance.to {
        return Err(DistanceFault::SamePoint);
    }
    check_distance(&distance)?;
    project.distances.push(distance);
    Ok(())
}

/// Whether length and standard error are positive numbers.
///
/// # Errors
/// Which of them is not.
pub fn check_distance(distance: &Distance) -> Result<(), DistanceFault> {
    let positive = |value: f64| value > 0.0 && value.is_finite();
    if !positive(distance.length) {
        return Err(DistanceFault::Length);
    }
    if positive(distance.sigma) { Ok(()) } else { Err(DistanceFault::Sigma) }
}

/// Changes a distance; its ends, where there is one at this place.
///
/// # Errors
/// What it would lack; then it stays as it was.
pub fn edit_distance(
    project: &mut Project,
    place: usize,
    edit: impl FnOnce(&mut Distance),
) -> Result<Option<(String, String)>, DistanceFault> {
    let Some(known) = project.distances.get_mut(place) else { return Ok(None) };
    let mut distance = known.clone();
    edit(&mut distance);
    check_distance(&distance)?;
    *known = distance;
    Ok(Some(ends(known)))
}

/// Has a distance compared only, or take part; its ends, where there is one at this place.
pub fn set_check(project: &mut Project, place: usize, check: bool) -> Option<(String, String)> {
    let distance = project.distances.get_mut(place)?;
    distance.check = check;
    Some(ends(distance))
}

/// Removes a distance; its ends, where there was one at this place.
pub fn remove_distance(project: &mut Project, place: usize) -> Option<(String, String)> {
    (place < project.distances.len()).then(|| ends(&project.distances.remove(place)))
}

fn ends(distance: &Distance) -> (String, String) {
    (distance.from.clone(), distance.to.clone())
}

/// Chooses what the coordinates refer to. Points that were named to carry the datum stay named.
pub fn set_datum(project: &mut Project, kind: DatumKind) {
    project.datum.kind = kind;
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(id: &str, x: f64) -> Point {
        Point { id: id.into(), xyz: Some([x, 0.0, 0.0]), sigma: Some([Some(0.1), None, None]), ..Point::default() }
    }

    fn take(project: &mut Project, points: Vec<Point>, unit: &str) {
        take_points(project, points, unit).expect("known units");
    }

    #[test]
    fn approximate_coordinates_leave_given_ones_alone() {
        let at = |id: &str, role, x: f64| Point { id: id.into(), role, xyz: Some([x; 3]), ..Point::default() };
        let mut project = Project { unit: "mm".into(), ..Project::default() };
        project.points = vec![at("given", Role::Control, 1.0), Point { id: "seen".into(), ..Point::default() }].into();
        let list = ["given", "seen", "new"].map(|id| at(id, Role::Tie, 2.0)).to_vec();
        assert_eq!(take_approximate(&mut project, list, "m"), Ok(2));
        let places: Vec<_> = project.points.iter().map(|p| (p.role, p.xyz.unwrap()[0])).collect();
        assert_eq!(places, [(Role::Control, 1.0), (Role::Tie, 2000.0), (Role::Tie, 2000.0)]);
    }

    #[test]
    fn the_first_coordinates_give_the_unit_and_later_ones_are_brought_to_it() {
        let mut p = Project::default();
        assert!(!has_lengths(&p));
        assert_eq!(take_points(&mut p, vec![point("1", 1.0)], "m"), Ok(1));
        assert_eq!((p.unit.as_str(), p.points[0].role), ("m", Role::Control));
        assert_eq!(p.datum.kind, DatumKind::Free);
        take(&mut p, vec![point("2", 500.0), point("3", 0.0)], "mm");
        assert_eq!(p.points[1].xyz, Some([0.5, 0.0, 0.0]));
        assert_eq!(p.points[1].sigma, Some([Some(0.0001), None, None]));
        assert_eq!(p.datum.kind, DatumKind::Control);
    }

    #[test]
    fn an_unknown_unit_and_what_leaves_the_range_of_numbers_are_refused_whole() {
        for (own, unit, x) in [("mm", "ell", 1.0), ("banana", "mm", 1.0), ("µm", "km", 1e95)] {
            let mut p = Project::default();
            take(&mut p, vec![point("1", 1.0)], own);
            let before = p.clone();
            assert!(take_points(&mut p, vec![point("2", 1.0), point("3", x)], unit).is_err(), "{own} {unit}");
            assert_eq!(p, before);
        }
        // A document in a unit of its own goes on in it.
        let mut p = Project::default();
        take(&mut p, vec![point("1", 1.0)], "banana");
        assert_eq!(take_points(&mut p, vec![point("2", 1.0)], "banana"), Ok(1));
    }

    #[test]
    fn a_point_taken_again_keeps_its_target() {
        let mut p = Project::default();
        p.points.push(Point { id: "1".into(), diameter: Some(8.0), ..Point::default() });
        take(&mut p, vec![Point { role: Role::Check, ..point("1", 1.0) }], "mm");
        assert_eq!((p.points.len(), p.points[0].diameter, p.points[0].role), (1, Some(8.0), Role::Check));
        set_role(&mut p, "1", Role::Control);
        set_coordinate(&mut p, "1", 2, 7.0);
        set_sigma(&mut p, "1", 0, None);
        assert_eq!(
            (p.points[0].role, p.points[0].xyz, p.points[0].sigma),
            (Role::Control, Some([1.0, 0.0, 7.0]), None)
        );
        set_sigma(&mut p, "1", 1, Some(0.5));
        assert_eq!(p.points[0].sigma, Some([None, Some(0.5), None]));
    }

    #[test]
    fn distances_are_checked() {
        let mut p = Project::default();
        take(&mut p, vec![point("1", 1.0), point("2", 2.0)], "mm");
        let distance = |from: &str, to: &str, length, sigma| Distance {
            from: from.into(),
            to: to.into(),
            length,
            sigma,
            check: false,
        };
        assert_eq!(add_distance(&mut p, distance("1", "9", 1.0, 0.1)), Err(DistanceFault::NoSuchPoint));
        assert_eq!(add_distance(&mut p, distance("1", "1", 1.0, 0.1)), Err(DistanceFault::SamePoint));
        assert_eq!(add_distance(&mut p, distance("1", "2", f64::NAN, 0.1)), Err(DistanceFault::Length));
        assert_eq!(add_distance(&mut p, distance("1", "2", 1.0, 0.0)), Err(DistanceFault::Sigma));
        assert_eq!(add_distance(&mut p, distance("1", "2", 1.0, 0.1)), Ok(()));
        assert!(has_lengths(&p));
    }

    #[test]
    fn one_distance_is_edited_switched_and_removed_and_no_other() {
        let mut p = Project::default();
        take(&mut p, vec![point("1", 1.0), point("2", 2.0), point("3", 3.0)], "mm");
        for (from, to) in [("1", "2"), ("2", "3")] {
            let distance = Distance { from: from.into(), to: to.into(), length: 1.0, sigma: 0.1, check: false };
            add_distance(&mut p, distance).expect("a distance");
        }
        let ends = Some(("2".to_owned(), "3".to_owned()));
        let first = p.distances[0].clone();
        assert_eq!(edit_distance(&mut p, 1, |d| d.length = 7.0), Ok(ends.clone()));
        assert_eq!(edit_distance(&mut p, 1, |d| d.sigma = 0.5), Ok(ends.clone()));
        assert_eq!(set_check(&mut p, 1, true), ends);
        let second = Distance { from: "2".into(), to: "3".into(), length: 7.0, sigma: 0.5, check: true };
        assert_eq!(p.distances, [first.clone(), second.clone()]);
        // what is refused, and what is not there, changes nothing
        assert_eq!(edit_distance(&mut p, 1, |d| d.length = -7.0), Err(DistanceFault::Length));
        assert_eq!(edit_distance(&mut p, 1, |d| d.sigma = f64::NAN), Err(DistanceFault::Sigma));
        assert_eq!(edit_distance(&mut p, 2, |d| d.length = 3.0), Ok(None));
        assert_eq!((set_check(&mut p, 2, true), remove_distance(&mut p, 2)), (None, None));
        assert_eq!(p.distances, [first, second.clone()]);
        assert_eq!(set_check(&mut p, 1, false), ends);
        assert!(!p.distances[1].check);
        assert_eq!(remove_distance(&mut p, 0), Some(("1".into(), "2".into())));
        assert_eq!(p.distances, [Distance { check: false, ..second }]);
    }

    #[test]
    fn the_datum_is_set_and_nothing_else() {
        let mut p = Project::default();
        take(&mut p, vec![point("1", 1.0)], "mm");
        p.datum.points = Some(vec!["1".into()]);
        set_datum(&mut p, DatumKind::Control);
        assert_eq!((p.datum.kind, p.datum.points.clone()), (DatumKind::Control, Some(vec!["1".to_owned()])));
    }
}
