//! Control: given coordinates, measured distances, unit and datum.

use sightline::Error;
pub use sightline::equipment::has_lengths;
use sightline::project::{DatumKind, Distance, LocalSystem, Origin, Point, Project, Role};
pub use sightline::units::Unit;
use sightline::units::factor;
use sightline_exchange::control_csv::Field;

/// Keeps the system that latitudes and longitudes of a list were converted into: later lists are converted into the same one.
pub fn set_local_system(project: &mut Project, system: LocalSystem, file: &str) {
    let made_here = || Box::new(Origin { format: Origin::LIST.into(), ..Origin::default() });
    let origin = project.origin.get_or_insert_with(made_here);
    origin.local_system = Some(system);
    // The files of another program's project are named by themselves.
    if origin.format == Origin::LIST && !origin.files.iter().any(|known| known == file) {
        origin.files.push(file.to_owned());
    }
}

/// What columns hold once the one at `place` holds `chosen`: no other one holds the same, and where that is a latitude or a longitude, the
/// column of the other system holds its counterpart.
pub fn hold(columns: &mut [Option<Field>], place: usize, chosen: Field) {
    let plane = [Field::X, Field::Y];
    let angles = [Field::Longitude, Field::Latitude];
    let (mine, others) = if chosen.is_angle() { (angles, plane) } else { (plane, angles) };
    let mut elsewhere: Vec<&mut Option<Field>> =
        columns.iter_mut().enumerate().filter(|(k, _)| *k != place).map(|(_, column)| column).collect();
    elsewhere.iter_mut().filter(|column| ***column == Some(chosen)).for_each(|column| **column = None);
    if let Some(axis) = mine.iter().position(|field| *field == chosen) {
        let counterpart = Some(mine[1 - axis]);
        for other in [others[1 - axis], others[axis]] {
            let known = elsewhere.iter().any(|column| **column == counterpart);
            let then = if known { None } else { counterpart };
            elsewhere.iter_mut().filter(|column| ***column == Some(other)).for_each(|column| **column = then);
        }
    }
    if let Some(column) = columns.get_mut(place) {
        *column = Some(chosen);
    }
}

/// Imports points as control points, or with the role stated in the list; they replace existing data. Their coordinates come in
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
    // Three points define a system: users then expect the control system.
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

/// Missing input before a distance can be added.
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
/// Its missing inputs.
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
/// Missing inputs; if there are any, it is not changed.
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

/// Chooses what the coordinates refer to. Points that were named to define the datum stay named.
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
    fn columns_are_of_one_system() {
        let plane = [Some(Field::Id), Some(Field::X), Some(Field::Y), Some(Field::Z), None];
        for (place, chosen, wanted) in [
            (
                1,
                Field::Latitude,
                [Some(Field::Id), Some(Field::Latitude), Some(Field::Longitude), Some(Field::Z), None],
            ),
            (
                1,
                Field::Longitude,
                [Some(Field::Id), Some(Field::Longitude), Some(Field::Latitude), Some(Field::Z), None],
            ),
            (
                4,
                Field::Latitude,
                [Some(Field::Id), Some(Field::Longitude), None, Some(Field::Z), Some(Field::Latitude)],
            ),
            (2, Field::X, [Some(Field::Id), None, Some(Field::X), Some(Field::Z), None]),
        ] {
            let mut columns = plane;
            hold(&mut columns, place, chosen);
            assert_eq!(columns, wanted, "{place} {chosen:?}");
        }
        let mut back = [Some(Field::Id), Some(Field::Latitude), Some(Field::Longitude), Some(Field::Z)];
        hold(&mut back, 1, Field::X);
        assert_eq!(back, [Some(Field::Id), Some(Field::X), Some(Field::Y), Some(Field::Z)]);
    }

    #[test]
    fn the_local_system_of_a_list_stays_with_the_project() {
        let system = LocalSystem { latitude: 37.5, longitude: 127.0, height: 30.0, ..LocalSystem::default() };
        let mut project = Project::default();
        for file in ["a.csv", "b.csv", "a.csv"] {
            set_local_system(&mut project, system, file);
        }
        let origin = project.origin.expect("an origin");
        assert_eq!((origin.format.as_str(), origin.local_system, origin.files.len()), (Origin::LIST, Some(system), 2));
        assert!(!origin.is_foreign());
        let colmap = Origin { format: "colmap".into(), files: vec!["a.txt".into()], ..Origin::default() };
        let mut project = Project { origin: Some(Box::new(colmap)), ..Project::default() };
        set_local_system(&mut project, system, "a.csv");
        let origin = project.origin.expect("an origin");
        assert_eq!((origin.format.as_str(), origin.local_system, origin.files.len()), ("colmap", Some(system), 1));
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
