//! Lists of distances: each between two points of the project, in its unit.

use sightline::Error;
use sightline::project::{Distance, Project};
use sightline::units::{Unit, factor};

use super::control::has_lengths;

/// What became of a list.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Taken {
    /// Distances that are in the project now.
    pub taken: usize,
    /// Names of points that the project does not have.
    pub strangers: Vec<String>,
}

/// Takes distances in place of those between the same points; one with an end that the project does not have is left out. Lengths come in
/// `unit`, none: in the project's; the first lengths of a project give it their unit.
///
/// # Errors
/// For lengths that cannot be converted; then nothing is taken.
pub fn take(project: &mut Project, distances: Vec<Distance>, unit: Option<Unit>) -> Result<Taken, Error> {
    let scale = match unit {
        Some(unit) if has_lengths(project) => factor(unit.symbol(), &project.unit)?,
        Some(unit) => {
            project.unit = unit.symbol().to_owned();
            1.0
        }
        None => 1.0,
    };
    let mut all = Taken::default();
    for distance in distances {
        let unknown = |id: &&String| !project.points.iter().any(|point| point.id == **id);
        let strangers: Vec<String> = [&distance.from, &distance.to].into_iter().filter(unknown).cloned().collect();
        if !strangers.is_empty() {
            all.strangers.extend(strangers);
            continue;
        }
        let ends = |d: &Distance| [d.from.clone().min(d.to.clone()), d.from.clone().max(d.to.clone())];
        let distance = Distance { length: distance.length * scale, sigma: distance.sigma * scale, ..distance };
        match project.distances.iter_mut().find(|known| ends(known) == ends(&distance)) {
            Some(known) => *known = Distance { check: known.check, ..distance },
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
        assert_eq!(taken, Taken { taken: 1, strangers: vec!["Z".into()] });
        assert_eq!((project.unit.as_str(), project.distances.len()), ("m", 1));
        // The same bar again, the other way round and in millimetres: it replaces the first.
        project.distances[0].check = true;
        take(
            &mut project,
            vec![distance("B", "A", 501.0, 0.1), distance("B", "C", 250.0, 0.1)],
            Some(Unit::Millimetre),
        )
        .unwrap();
        assert_eq!(project.distances.len(), 2);
        assert!((project.distances[0].length - 0.501).abs() < 1e-12 && project.distances[0].check);
        assert!((project.distances[1].sigma - 1e-4).abs() < 1e-15);
    }
}
