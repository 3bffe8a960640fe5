//! Adds the named dots of a board to the document.

use sightline::matching::GridNaming;
use sightline::project::{DatumKind, Project, Role};

/// Takes points and observations of a board. Control points that nothing else fixes become the datum; how many observations are new.
pub fn take(project: &mut Project, naming: GridNaming) -> usize {
    let count = naming.observations.len();
    let control = naming.points.iter().filter(|p| p.role == Role::Control).count();
    project.points.extend(naming.points);
    project.observations.extend(naming.observations);
    if control >= 3 && project.datum.kind == DatumKind::Free && project.datum.points.is_none() {
        project.datum.kind = DatumKind::Control;
    }
    count
}

#[cfg(test)]
mod tests {
    use sightline::project::{Observation, Point, Sigma};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn control_points_of_a_board_are_the_datum_and_tie_points_are_not() {
        let naming = |role: Role| {
            let id = |k: usize| format!("r1c{k}");
            let point = |k| Point { id: id(k), role, xyz: Some([20.0 * k as f64, 0.0, 0.0]), ..Point::default() };
            let observation = |k| Observation {
                photo: "a".into(),
                point: id(k),
                u: 10.0 * k as f64,
                v: 5.0,
                sigma: Sigma::One(0.1),
                enabled: true,
                target: Some(k as u32),
            };
            GridNaming {
                points: (1..4).map(point).collect(),
                observations: (1..4).map(observation).collect(),
                ..GridNaming::default()
            }
        };
        let (mut controlled, mut free) = (Project::default(), Project::default());
        assert_eq!((take(&mut controlled, naming(Role::Control)), take(&mut free, naming(Role::Tie))), (3, 3));
        assert_eq!((controlled.datum.kind, free.datum.kind), (DatumKind::Control, DatumKind::Free));
        assert_eq!(free.points[2].xyz, Some([60.0, 0.0, 0.0]));
    }
}
