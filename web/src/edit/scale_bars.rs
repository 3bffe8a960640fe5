//! Lists of distances: each between two points of the project, in its unit.

use sightline::Error;
use sightline::project::{Distance, Project};
use sightline::units::{Unit, factor};

use super::control::has_lengths;

/// Result of importing a list of distances.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImportedDistances {
    /// Distances that are in the project now.
    pub taken: usize,
    /// Distances of the project that gave way, with those in their place.
    pub replaced: Vec<(Distance, Distance)>,
    /// Names of points that the project does not have.
    pub strangers: Vec<String>,
}

/// Takes distances in place of those that the project had between the same points, whose "check only" stays; what the list has twice was measured
/// twice, and both take part. One with an end that the project does not have is left out. Lengths come in
/// `unit`, none: in the project's; the first lengths of a project give it their unit.
///
/// # Errors
/// For lengths that cannot be converted; then nothing is taken.
pub fn take(project: &mut Project, distances: Vec<Distance>, unit: Option<Unit>) -> Result<ImportedDistances, Error> {
    let scale = match unit {
        Some(unit) if has_lengths(project) => factor(unit.symbol(), &project.unit)?,
        Some(unit) => {
            project.unit = unit.symbol().to_owned();
            1.0
        }
        None => 1.0,
    };
    let mut all = ImportedDistances::default();
    // Indices of the project's previous distances that the list does not replace.
    let mut earlier: Vec<usize> = (0..project.distances.len()).collect();
    for distance in distances {
        let unknown = |id: &&String| !project.points.iter().any(|point| point.id == **id);
        let strangers: Vec<String> = [&distance.from, &distance.to].into_iter().filter(unknown).cloned().collect();
        if !strangers.is_empty() {
            all.strangers.extend(strangers);
            continue;
        }
        let ends = |d: &Distance| [d.from.clone().min(d.to.clone()), d.from.clone().max(d.to.clone())];
        let distance = Distance { length: distance.length * scale, sigma: distance.sigma * scale, ..distance };
        match earlier.iter().position(|k| ends(&project.distances[*k]) == ends(&distance)) {
            Some(place) => {
                let known = &mut project.distances[earlier.remove(place)];
                let distance = Distance { check: known.check, ..distance };
                all.replaced.push((std::mem::replace(known, distance.clone()), distance));
            }
            None => project.distances.push(distance),
        }
        all.taken += 1;
    }
    all.strangers.dedup();
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use sightline::project::Point;

    #[test]
    fn distances_come_in_the_unit_of_the_project() {
        let points = ["A", "B", "C"].map(|id| Point { id: id.into(), ..Point::default() });
        let mut project = Project { points: points.to_vec().into(), ..Project::default() };
        let distance = |from: &str, to: &str, length, sigma| Distance {
            from: from.into(),
            to: to.into(),
            length,
            sigma,
            check: false,
        };
        let list = vec![distance("A", "B", 0.5, 1e-4), distance("A", "Z", 1.0, 1e-4)];
        let taken = take(&mut project, list, Some(Unit::Metre)).unwrap();
        assert_eq!(taken, ImportedDistances { taken: 1, replaced: Vec::new(), strangers: vec!["Z".into()] });
        assert_eq!((project.unit.as_str(), project.distances.len()), ("m", 1));
        // The same bar again, the other way round and in millimetres: it replaces the first.
        project.distances[0].check = true;
        let list = vec![distance("B", "A", 501.0, 0.1), distance("B", "C", 250.0, 0.1)];
        let taken = take(&mut project, list, Some(Unit::Millimetre)).unwrap();
        let lengths: Vec<_> = taken.replaced.iter().map(|(was, is)| (was.length, (is.length * 1e6).round())).collect();
        assert_eq!((taken.taken, lengths), (2, vec![(0.5, 501_000.0)]));
        assert_eq!(project.distances.len(), 2);
        assert!((project.distances[0].length - 0.501).abs() < 1e-12 && project.distances[0].check);
        assert!((project.distances[1].sigma - 1e-4).abs() < 1e-15);
    }

    /// A bar measured twice is two observations; a list replaces what was there before it, not its own rows.
    #[test]
    fn what_a_list_has_twice_was_measured_twice() {
        let points = ["A", "B"].map(|id| Point { id: id.into(), ..Point::default() });
        let mut project = Project { points: points.to_vec().into(), unit: "m".into(), ..Project::default() };
        let distance = |length| Distance { from: "A".into(), to: "B".into(), length, sigma: 1e-4, check: false };
        project.distances = vec![distance(0.4)];
        let taken = take(&mut project, vec![distance(0.5), distance(0.5002)], Some(Unit::Metre)).unwrap();
        assert_eq!((taken.taken, taken.replaced.len()), (2, 1));
        assert_eq!(project.distances.iter().map(|d| d.length).collect::<Vec<_>>(), [0.5, 0.5002]);
    }
}
