//! What is measured on the result: features of chosen points and of each other, coordinate systems, lines between points.

use std::collections::BTreeSet;

use sightline::project::{
    CoordinateSystem, DrawnLine, End, Feature, FeatureKind, GivenPoint, Layer, Project, SystemKind,
};

use super::natural;

/// Colours of new layers, distinguishable on white and on black.
const COLOURS: [[u8; 3]; 6] =
    [[0, 110, 200], [200, 90, 0], [0, 140, 70], [180, 0, 140], [130, 110, 0], [120, 120, 120]];

/// Missing selection for a new feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lacks {
    /// So many chosen points at least.
    Points(usize),
    /// Two ends: points, features, or one of each.
    TwoEnds,
    /// Two features with a direction, or three points.
    Angle,
    /// One feature to deviate from, or points with given coordinates.
    OneFeature,
    /// A plane and a line among the chosen features, and one point.
    PlaneLinePoint,
    /// Three points with given coordinates.
    Given,
}

/// A feature of this kind from chosen points and chosen features.
///
/// # Errors
/// Its missing inputs.
pub fn made(kind: &str, project: &Project, points: &[String], features: &[String]) -> Result<FeatureKind, Lacks> {
    let at_least = |n: usize| if points.len() >= n { Ok(points.to_vec()) } else { Err(Lacks::Points(n)) };
    let ends: Vec<End> =
        features.iter().cloned().map(End::Feature).chain(points.iter().cloned().map(End::Point)).collect();
    match kind {
        "line" => Ok(FeatureKind::Line { points: at_least(2)? }),
        "plane" => Ok(FeatureKind::Plane { points: at_least(3)? }),
        "circle" => Ok(FeatureKind::Circle { points: at_least(3)? }),
        "sphere" => Ok(FeatureKind::Sphere { points: at_least(4)? }),
        "cylinder" => Ok(FeatureKind::Cylinder { points: at_least(6)? }),
        "distance" => match &ends[..] {
            [from, to] => Ok(FeatureKind::Distance { from: from.clone(), to: to.clone() }),
            _ => Err(Lacks::TwoEnds),
        },
        "angle" => match &ends[..] {
            [from @ End::Feature(_), to @ End::Feature(_)] => {
                Ok(FeatureKind::Angle { from: from.clone(), at: None, to: to.clone() })
            }
            [from @ End::Point(_), at, to] => {
                Ok(FeatureKind::Angle { from: from.clone(), at: Some(at.clone()), to: to.clone() })
            }
            _ => Err(Lacks::Angle),
        },
        _ => match features {
            [feature] => Ok(FeatureKind::Deviations {
                points: points.to_vec(),
                feature: Some(feature.clone()),
                given: Vec::new(),
            }),
            [] => {
                let given: Vec<_> = given(project, points);
                if given.is_empty() { Err(Lacks::OneFeature) } else { Ok(of_given(given)) }
            }
            _ => Err(Lacks::OneFeature),
        },
    }
}

/// Given coordinates of these points, or of all that have some, with their standard errors.
fn given(project: &Project, points: &[String]) -> Vec<GivenPoint> {
    let sigma = |id: &str| {
        let [x, y, z] = project.points.iter().find(|p| p.id == id)?.sigma?;
        Some([x?, y?, z?]).filter(|s| s.iter().all(|s| *s > 0.0))
    };
    let mut given: Vec<_> = project.given_points().filter(|g| points.is_empty() || points.contains(&g.id)).collect();
    // Weights are the standard errors of all, or none: one without would weigh as if it had one unit.
    let sigmas: Option<Vec<_>> = given.iter().map(|g| sigma(&g.id)).collect();
    for (point, sigma) in given.iter_mut().zip(sigmas.into_iter().flatten()) {
        point.sigma = Some(sigma);
    }
    given
}

fn of_given(given: Vec<GivenPoint>) -> FeatureKind {
    FeatureKind::Deviations { points: Vec::new(), feature: None, given }
}

/// A coordinate system of this kind from chosen points and features.
///
/// # Errors
/// Its missing inputs.
pub fn laid(kind: &str, project: &Project, points: &[String], features: &[String]) -> Result<SystemKind, Lacks> {
    let of = |wanted: &str| {
        let all = features.iter().filter_map(|id| project.features.iter().find(|f| f.id == *id));
        all.filter(|f| f.kind.name() == wanted).map(|f| f.kind.points().to_vec()).next()
    };
    match kind {
        "automatic" if points.is_empty() || points.len() >= 3 => Ok(SystemKind::Automatic { points: points.to_vec() }),
        "automatic" => Err(Lacks::Points(3)),
        "plane_line_point" => match (of("plane"), of("line"), points) {
            (Some(plane), Some(line), [point]) => Ok(SystemKind::PlaneLinePoint { plane, line, point: point.clone() }),
            _ => Err(Lacks::PlaneLinePoint),
        },
        _ => {
            let given = given(project, points);
            if given.len() < 3 { Err(Lacks::Given) } else { Ok(SystemKind::BestFit { given, scale: false }) }
        }
    }
}

/// A letter, or two, that no feature and no system has.
pub fn free_letter(project: &Project) -> String {
    let taken: BTreeSet<&str> =
        project.features.iter().map(|f| f.id.as_str()).chain(project.systems.iter().map(|s| s.id.as_str())).collect();
    let letter = |n: usize| char::from(b'A' + (n % 26) as u8);
    let name = |n: usize| if n < 26 { letter(n).to_string() } else { format!("{}{}", letter(n / 26 - 1), letter(n)) };
    (0..).map(name).find(|name| !taken.contains(name.as_str())).unwrap_or_default()
}

/// Adds a feature under the next free letter.
pub fn add(project: &mut Project, kind: FeatureKind) -> String {
    let id = free_letter(project);
    project.features.push(Feature { id: id.clone(), kind });
    id
}

/// Adds a coordinate system under the next free letter.
pub fn add_system(project: &mut Project, kind: SystemKind) -> String {
    let id = free_letter(project);
    project.systems.push(CoordinateSystem { id: id.clone(), kind });
    id
}

fn built_on<'a>(kind: &'a FeatureKind) -> Vec<&'a String> {
    let end = |end: &'a End| match end {
        End::Feature(id) => Some(id),
        End::Point(_) => None,
    };
    match kind {
        FeatureKind::Distance { from, to } => [from, to].into_iter().filter_map(end).collect(),
        FeatureKind::Angle { from, at, to } => {
            [Some(from), at.as_ref(), Some(to)].into_iter().flatten().filter_map(end).collect()
        }
        FeatureKind::Deviations { feature, .. } => feature.iter().collect(),
        _ => Vec::new(),
    }
}

/// Takes a feature or a system away, and the features that are built on it; how many of those.
pub fn remove(project: &mut Project, id: &str) -> usize {
    project.systems.retain(|s| s.id != id);
    let before = project.features.len();
    let gone = project.features.iter().any(|f| f.id == id);
    project.features.retain(|f| f.id != id && !built_on(&f.kind).iter().any(|on| *on == id));
    before - project.features.len() - usize::from(gone)
}

/// Gives a feature or a system another name; false if that is taken or empty.
pub fn rename(project: &mut Project, from: &str, to: &str) -> bool {
    let to = to.trim();
    let taken = project.features.iter().any(|f| f.id == to) || project.systems.iter().any(|s| s.id == to);
    if to.is_empty() || taken {
        return false;
    }
    let other = |id: &mut String| {
        if id == from {
            to.clone_into(id);
        }
    };
    let end = |end: &mut End| {
        if let End::Feature(id) = end {
            other(id);
        }
    };
    for feature in &mut project.features {
        other(&mut feature.id);
        match &mut feature.kind {
            FeatureKind::Distance { from, to } => [from, to].into_iter().for_each(end),
            FeatureKind::Angle { from, at, to } => {
                [Some(from), at.as_mut(), Some(to)].into_iter().flatten().for_each(end)
            }
            FeatureKind::Deviations { feature: Some(feature), .. } => other(feature),
            _ => {}
        }
    }
    project.systems.iter_mut().for_each(|s| other(&mut s.id));
    true
}

/// Whether the scale of a best fit is fitted too.
pub fn scale(project: &mut Project, id: &str, fitted: bool) {
    for system in project.systems.iter_mut().filter(|s| s.id == id) {
        if let SystemKind::BestFit { scale, .. } = &mut system.kind {
            *scale = fitted;
        }
    }
}

/// Joins points by lines, one after the other, where they are not joined yet; how many lines.
pub fn join(project: &mut Project, points: &[String], layer: &str) -> usize {
    let before = project.lines.len();
    if !layer.is_empty() && !project.layers.iter().any(|l| l.id == layer) {
        let colour = COLOURS[project.layers.len() % COLOURS.len()];
        project.layers.push(Layer { id: layer.to_owned(), colour });
    }
    for pair in points.windows(2) {
        let same = |l: &DrawnLine| (l.from == pair[0] && l.to == pair[1]) || (l.from == pair[1] && l.to == pair[0]);
        if pair[0] != pair[1] && !project.lines.iter().any(same) {
            project.lines.push(DrawnLine { from: pair[0].clone(), to: pair[1].clone(), layer: layer.to_owned() });
        }
    }
    project.lines.len() - before
}

/// Gives a layer another colour.
pub fn recolour(project: &mut Project, layer: &str, colour: [u8; 3]) {
    project.layers.iter_mut().filter(|l| l.id == layer).for_each(|l| l.colour = colour);
}

/// Takes the lines away that join two of these points; how many.
pub fn part(project: &mut Project, points: &[String]) -> usize {
    let before = project.lines.len();
    project.lines.retain(|l| !(points.contains(&l.from) && points.contains(&l.to)));
    before - project.lines.len()
}

/// Points named in a text: names apart by commas or spaces, ranges by a dash (201-212). Those that are not there come second.
pub fn named(project: &Project, text: &str) -> (Vec<String>, Vec<String>) {
    let known: BTreeSet<&str> = project.points.iter().map(|p| p.id.as_str()).collect();
    let (mut found, mut unknown) = (Vec::new(), Vec::new());
    for word in text.split([',', ';', ' ', '\t', '\n']).filter(|w| !w.is_empty()) {
        let range = word.split_once(['-', '\u{2013}']).filter(|(a, b)| !a.is_empty() && !b.is_empty());
        match range {
            _ if known.contains(word) => found.push(word.to_owned()),
            Some((from, to)) if known.contains(from) && known.contains(to) => {
                let (from, to) = if natural(from, to).is_gt() { (to, from) } else { (from, to) };
                let mut inside: Vec<&str> =
                    known.iter().copied().filter(|id| natural(from, id).is_le() && natural(id, to).is_le()).collect();
                inside.sort_by(|a, b| natural(a, b));
                found.extend(inside.into_iter().map(str::to_owned));
            }
            _ => unknown.push(word.to_owned()),
        }
    }
    let mut seen = BTreeSet::new();
    found.retain(|id| seen.insert(id.clone()));
    (found, unknown)
}

#[cfg(test)]
mod tests {
    use sightline::project::{Point, Role};

    use super::*;

    fn names(all: &[&str]) -> Vec<String> {
        all.iter().map(|s| (*s).to_owned()).collect()
    }

    fn project() -> Project {
        let point = |k: usize| Point { id: k.to_string(), ..Point::default() };
        Project { points: (1..=12).map(point).collect(), ..Project::default() }
    }

    #[test]
    fn features_are_made_of_what_is_chosen_and_say_what_they_lack() {
        assert_eq!(made("plane", &project(), &names(&["1", "2"]), &[]), Err(Lacks::Points(3)));
        assert!(
            matches!(made("plane", &project(), &names(&["1", "2", "3"]), &[]), Ok(FeatureKind::Plane { points }) if points.len() == 3)
        );
        assert_eq!(made("distance", &project(), &names(&["1"]), &[]), Err(Lacks::TwoEnds));
        let mixed = made("distance", &project(), &names(&["1"]), &names(&["A"]));
        assert_eq!(mixed, Ok(FeatureKind::Distance { from: End::Feature("A".into()), to: End::Point("1".into()) }));
        assert!(
            matches!(made("angle", &project(), &names(&["1", "2", "3"]), &[]), Ok(FeatureKind::Angle { at: Some(End::Point(at)), .. }) if at == "2")
        );
        assert_eq!(made("angle", &project(), &names(&["1"]), &names(&["A"])), Err(Lacks::Angle));
        assert_eq!(made("deviations", &project(), &[], &[]), Err(Lacks::OneFeature));
    }

    #[test]
    fn names_are_free_and_what_is_built_on_a_feature_goes_with_it() {
        let mut p = project();
        let a = add(&mut p, made("plane", &project(), &names(&["1", "2", "3"]), &[]).expect("a plane"));
        let b = add(&mut p, made("distance", &project(), &names(&["4"]), &names(&["A"])).expect("a distance"));
        let system = laid("automatic", &p, &[], &[]).expect("a system");
        let c = add_system(&mut p, system);
        assert_eq!((a.as_str(), b.as_str(), c.as_str()), ("A", "B", "C"));
        assert!(rename(&mut p, "A", "base") && !rename(&mut p, "B", "base") && !rename(&mut p, "B", " "));
        assert!(p.validate().is_ok(), "the distance follows the name");
        assert_eq!(remove(&mut p, "base"), 1);
        assert!(p.features.is_empty() && p.systems.len() == 1);
        assert_eq!((remove(&mut p, "C"), p.systems.len()), (0, 0));
    }

    #[test]
    fn systems_say_what_they_lack() {
        let mut p = project();
        assert_eq!(laid("best_fit", &p, &[], &[]), Err(Lacks::Given));
        for k in 0..3 {
            (p.points[k].role, p.points[k].xyz) = (Role::Control, Some([k as f64, 0.0, 1.0]));
        }
        assert!(matches!(laid("best_fit", &p, &[], &[]), Ok(SystemKind::BestFit { given, .. }) if given.len() == 3));
        assert_eq!(laid("plane_line_point", &p, &names(&["1"]), &[]), Err(Lacks::PlaneLinePoint));
        add(&mut p, made("plane", &project(), &names(&["1", "2", "3"]), &[]).expect("a plane"));
        add(&mut p, made("line", &project(), &names(&["4", "5"]), &[]).expect("a line"));
        assert!(laid("plane_line_point", &p, &names(&["1"]), &names(&["A", "B"])).is_ok());
    }

    #[test]
    fn points_are_named_singly_and_in_ranges() {
        let p = project();
        assert_eq!(named(&p, "2, 9-11 x 3 3"), (names(&["2", "9", "10", "11", "3"]), names(&["x"])));
        assert_eq!(named(&p, "4–2").0, names(&["2", "3", "4"]));
    }

    #[test]
    fn lines_join_points_once() {
        let mut p = project();
        assert_eq!(join(&mut p, &names(&["1", "2", "3", "1"]), "edge"), 3);
        assert_eq!(join(&mut p, &names(&["3", "2"]), "edge"), 0);
        assert_eq!(p.layers.len(), 1);
        assert_eq!((part(&mut p, &names(&["1", "2"])), p.lines.len()), (1, 2));
    }
}
