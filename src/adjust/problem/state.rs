//! Values of the unknowns, and the frame they are in.

use nalgebra::{Matrix3, Vector3};

use crate::project::{Interior, Parameter};
use crate::rotation;

/// Coordinates inside are (X - offset) / scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Centre of the object.
    pub offset: [f64; 3],
    /// Size of the object.
    pub scale: f64,
}

impl Frame {
    /// Centre and rms radius of the points; of the photos where the points coincide.
    pub fn around(points: impl Iterator<Item = [f64; 3]>, photos: impl Iterator<Item = [f64; 3]>) -> Self {
        let points: Vec<[f64; 3]> = points.collect();
        let mean = |list: &[[f64; 3]]| -> [f64; 3] {
            std::array::from_fn(|a| list.iter().map(|p| p[a]).sum::<f64>() / list.len().max(1) as f64)
        };
        let offset = mean(&points);
        let radius = |list: &[[f64; 3]]| {
            let squares: f64 = list.iter().map(|p| (0..3).map(|a| (p[a] - offset[a]).powi(2)).sum::<f64>()).sum();
            (squares / list.len().max(1) as f64).sqrt()
        };
        let photos: Vec<[f64; 3]> = photos.collect();
        let scale = [radius(&points), radius(&photos)].into_iter().find(|r| *r > 0.0 && r.is_finite()).unwrap_or(1.0);
        Self { offset, scale }
    }

    /// From the object system.
    pub fn inside(&self, xyz: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|a| (xyz[a] - self.offset[a]) / self.scale)
    }

    /// To the object system.
    pub fn outside(&self, xyz: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|a| xyz[a] * self.scale + self.offset[a])
    }
}

/// Exterior orientation; the attitude as its matrix, object to camera, so that none is singular.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExteriorOrientation {
    /// Object to camera, rows.
    pub m: [[f64; 3]; 3],
    /// Projection centre.
    pub centre: [f64; 3],
}

impl ExteriorOrientation {
    /// From a projection centre and omega, phi, kappa.
    pub fn new(centre: [f64; 3], angles: [f64; 3]) -> Self {
        Self { m: rows(&rotation::object_to_camera(angles)), centre }
    }

    /// The attitude as a matrix.
    pub fn matrix(&self) -> Matrix3<f64> {
        Matrix3::from_fn(|i, j| self.m[i][j])
    }

    /// The point in the camera frame.
    #[inline]
    pub fn camera_point(&self, x: &[f64; 3]) -> [f64; 3] {
        let d = [x[0] - self.centre[0], x[1] - self.centre[1], x[2] - self.centre[2]];
        let row = |m: &[f64; 3]| m[0] * d[0] + m[1] * d[1] + m[2] * d[2];
        [row(&self.m[0]), row(&self.m[1]), row(&self.m[2])]
    }

    pub fn turned(&self, step: &[f64]) -> Self {
        let m = rotation::turned(&self.matrix(), Vector3::new(step[0], step[1], step[2]));
        Self { m: rows(&m), centre: std::array::from_fn(|a| self.centre[a] + step[3 + a]) }
    }
}

/// Rows of a matrix.
pub fn rows(m: &Matrix3<f64>) -> [[f64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| m[(i, j)]))
}

/// Values of all unknowns, in the order of the network's blocks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// Photos.
    pub poses: Vec<ExteriorOrientation>,
    /// Interior orientations.
    pub interiors: Vec<Interior>,
    /// Points.
    pub points: Vec<[f64; 3]>,
}

impl State {
    /// Whether every value is a number and every principal distance positive.
    pub fn is_sound(&self) -> bool {
        let finite = |x: &f64| x.abs() < 1e150;
        self.poses.iter().all(|p| p.centre.iter().chain(p.m.iter().flatten()).all(finite))
            && self.points.iter().flatten().all(finite)
            && self.interiors.iter().all(|i| {
                let distances = [Parameter::C, Parameter::Fx, Parameter::Fy];
                distances.iter().filter_map(|p| i.get(*p)).all(|c| c > 0.0)
                    && i.parameters().iter().filter_map(|p| i.get(*p)).all(|x| finite(&x))
            })
    }

    /// Removes the rounding that repeated turns leave in the attitudes.
    pub fn orthonormalise(&mut self) {
        for pose in &mut self.poses {
            pose.m = rows(&rotation::nearest(&pose.matrix()));
        }
    }
}
