//! A sphere: d = |x - c| - r; initial values by the linear equation |x|² = 2c·x + (r² - |c|²).

use nalgebra::{Matrix3, Matrix4, Vector3, Vector4};

use super::form::{GeometricForm, LinearisedDistance, MOST, Second};

/// Centre and radius.
#[derive(Clone, Debug)]
pub struct Sphere {
    pub centre: Vector3<f64>,
    pub radius: f64,
}

impl Sphere {
    /// Of least squared algebraic distances; `None` if the points lie in a plane. Points are about 0 and of size 1.
    pub fn initial(points: &[Vector3<f64>]) -> Option<Self> {
        let (mut normal, mut right) = (Matrix4::zeros(), Vector4::zeros());
        for x in points {
            let row = Vector4::new(2.0 * x.x, 2.0 * x.y, 2.0 * x.z, 1.0);
            normal += row * row.transpose();
            right += row * x.norm_squared();
        }
        let solution = normal.cholesky()?.solve(&right);
        let centre: Vector3<f64> = solution.fixed_rows::<3>(0).into_owned();
        let radius = (solution[3] + centre.norm_squared()).sqrt();
        (radius.is_finite() && radius > 0.0).then_some(Self { centre, radius })
    }
}

impl GeometricForm for Sphere {
    /// Centre, radius.
    const PARAMETERS: usize = 4;

    fn rows(&self, points: &[Vector3<f64>]) -> Vec<LinearisedDistance> {
        let row = |(point, x): (usize, &Vector3<f64>)| {
            let v = x - self.centre;
            let length = v.norm();
            // At the centre no direction is nearer than another.
            let outwards = if length > 0.0 { v / length } else { Vector3::z() };
            let mut by_form = [0.0; MOST];
            by_form[..4].copy_from_slice(&[-outwards.x, -outwards.y, -outwards.z, -1.0]);
            LinearisedDistance { point, distance: length - self.radius, by_form, by_point: outwards }
        };
        points.iter().enumerate().map(row).collect()
    }

    /// ∂²d = (I - o oᵀ)/|x - c| with o from the centre to the point.
    fn second(&self, point: &Vector3<f64>) -> Second {
        let v = point - self.centre;
        let (length, mut second) = (v.norm(), Second::zeros());
        if length > 0.0 {
            let across = Matrix3::identity() - v * v.transpose() / (length * length);
            let part = across * ((length - self.radius) / length);
            second.by_form.fixed_view_mut::<3, 3>(0, 0).copy_from(&part);
            (0..3).for_each(|k| second.by_point[k] = -part.column(k).into_owned());
        }
        second
    }

    fn moved(&self, step: &[f64; MOST]) -> Self {
        Self { centre: self.centre + Vector3::new(step[0], step[1], step[2]), radius: self.radius + step[3] }
    }

    fn anchored(self, _: &Vector3<f64>) -> Self {
        self
    }

    fn distance(&self, point: &Vector3<f64>) -> f64 {
        (point - self.centre).norm() - self.radius
    }
}
