//! Exchanged and negated axes, and their correction in a project.

use crate::adjustment::Exchange;
use crate::project::{Project, Role};
use nalgebra::Matrix3;

impl Exchange {
    /// Every one.
    pub const ALL: [Self; 6] = [Self::Xy, Self::Xz, Self::Yz, Self::X, Self::Y, Self::Z];

    /// Source axis and sign of every axis after the exchange.
    fn axes(self) -> [(usize, f64); 3] {
        match self {
            Self::Xy => [(1, 1.0), (0, 1.0), (2, 1.0)],
            Self::Xz => [(2, 1.0), (1, 1.0), (0, 1.0)],
            Self::Yz => [(0, 1.0), (2, 1.0), (1, 1.0)],
            Self::X => [(0, -1.0), (1, 1.0), (2, 1.0)],
            Self::Y => [(0, 1.0), (1, -1.0), (2, 1.0)],
            Self::Z => [(0, 1.0), (1, 1.0), (2, -1.0)],
        }
    }

    /// The exchange as a matrix of determinant -1, its own inverse.
    pub fn matrix(self) -> Matrix3<f64> {
        let mut matrix = Matrix3::zeros();
        for (row, (column, sign)) in self.axes().into_iter().enumerate() {
            matrix[(row, column)] = sign;
        }
        matrix
    }

    /// Coordinates after the exchange. No digit changes.
    pub fn of(self, xyz: [f64; 3]) -> [f64; 3] {
        // 0 with the other sign would be -0.
        self.axes().map(|(axis, sign)| if sign < 0.0 { 0.0 - xyz[axis] } else { xyz[axis] })
    }

    /// Standard errors after the exchange.
    fn of_sigmas(self, sigma: [Option<f64>; 3]) -> [Option<f64>; 3] {
        self.axes().map(|(axis, _)| sigma[axis])
    }
}

/// The project with the axes of everything that was given in the object's system exchanged: coordinates and standard errors of control
/// and check points, observed projection centres, normals of targets.
///
/// Exterior orientations and coordinates of tie points were made in the mirrored system, which no rotation leads out of: they become
/// null, and the project is to be oriented anew. Twice the same exchange gives the given coordinates back.
pub fn exchange_axes(project: &Project, exchange: Exchange) -> Project {
    let mut project = project.clone();
    for point in &mut project.points {
        point.normal = point.normal.map(|normal| exchange.of(normal));
        if point.role == Role::Tie {
            point.xyz = None;
        } else {
            point.xyz = point.xyz.map(|xyz| exchange.of(xyz));
            point.sigma = point.sigma.map(|sigma| exchange.of_sigmas(sigma));
        }
    }
    for photo in &mut project.photos {
        photo.rotation = None;
        photo.position = photo.position.filter(|_| photo.sigma_position.is_some()).map(|xyz| exchange.of(xyz));
        photo.sigma_position = photo.sigma_position.map(|sigma| exchange.of_sigmas(sigma));
    }
    project
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::{Photo, Point};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn every_exchange_mirrors_and_undoes_itself() {
        for exchange in Exchange::ALL {
            let matrix = exchange.matrix();
            assert!((matrix.determinant() + 1.0).abs() < 1e-15 && matrix * matrix == Matrix3::identity());
            let xyz = [0.1, 1e6 + 0.2, -0.3];
            let by_matrix: [f64; 3] = (matrix * nalgebra::Vector3::from(xyz)).into();
            assert_eq!(exchange.of(xyz), by_matrix);
            assert_eq!(exchange.of(exchange.of(xyz)), xyz);
        }
    }

    #[test]
    fn given_coordinates_go_over_with_their_sigmas_and_what_was_made_of_them_goes() {
        let sigma = Some([Some(1.0), None, Some(3.0)]);
        let point =
            |id: &str, role| Point { id: id.into(), role, xyz: Some([1.0, 2.0, 3.0]), sigma, ..Point::default() };
        let points = vec![point("c", Role::Control), point("k", Role::Check), point("t", Role::Tie)];
        let mut project = Project { points: points.into(), ..Project::default() };
        let photo = Photo { position: Some([1.0, 2.0, 3.0]), rotation: Some([0.1; 3]), ..Photo::default() };
        project.photos = vec![photo.clone(), Photo { sigma_position: sigma, ..photo }].into();
        let exchanged = exchange_axes(&project, Exchange::Xy);
        for point in &exchanged.points[..2] {
            assert_eq!((point.xyz, point.sigma), (Some([2.0, 1.0, 3.0]), Some([None, Some(1.0), Some(3.0)])));
        }
        assert_eq!(exchanged.points[2].xyz, None);
        assert_eq!((exchanged.photos[0].position, exchanged.photos[0].rotation), (None, None));
        assert_eq!((exchanged.photos[1].position, exchanged.photos[1].rotation), (Some([2.0, 1.0, 3.0]), None));
        assert_eq!(exchanged.photos[1].sigma_position, Some([None, Some(1.0), Some(3.0)]));
    }
}
