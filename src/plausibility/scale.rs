//! Whether the project has a scale.

use crate::project::{DatumKind, Project, Role};

/// Whether a document gives a scale: a distance that takes part, two given points, or two observed projection centres where the control
/// points are the datum. `distances` tells how many distances take part.
///
/// Coordinates of tie points and orientations of photos are initial values: their size is whatever it is.
pub fn is_given(project: &Project, distances: usize) -> bool {
    let control = project.points.iter().filter(|p| p.role == Role::Control && p.xyz.is_some()).count();
    let centres = project.photos.iter().filter(|p| p.enabled && p.position.is_some() && is_observed(p.sigma_position));
    let centres = if project.datum.kind == DatumKind::Control { centres.count() } else { 0 };
    distances > 0 || control + centres >= 2
}

fn is_observed(sigma: Option<[Option<f64>; 3]>) -> bool {
    sigma.is_some_and(|sigma| sigma.iter().all(Option::is_some))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::{Photo, Point};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn initial_values_are_no_scale() {
        let point = |role, xyz| Point { role, xyz, ..Point::default() };
        let mut project = Project { points: vec![point(Role::Tie, Some([1.0; 3])); 5].into(), ..Project::default() };
        assert!(!is_given(&project, 0) && is_given(&project, 1));
        project.points.push(point(Role::Control, Some([0.0; 3])));
        assert!(!is_given(&project, 0));
        let photo = Photo { enabled: true, position: Some([0.0; 3]), ..Photo::default() };
        project.photos = vec![photo.clone(), Photo { sigma_position: Some([Some(0.1); 3]), ..photo }].into();
        assert!(!is_given(&project, 0));
        project.datum.kind = DatumKind::Control;
        assert!(is_given(&project, 0));
        project.datum.kind = DatumKind::Free;
        project.points.push(point(Role::Control, None));
        assert!(!is_given(&project, 0));
        project.points.push(point(Role::Control, Some([1.0; 3])));
        assert!(is_given(&project, 0));
    }
}
