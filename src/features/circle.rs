//! A circle in space. The distance of a point has a part perpendicular to the plane, h = n·(x - c), and a part in the plane,
//! |x - c - h n| - r; the sum of squares of both is minimised. Initial values in the plane of the points, by the linear equation
//! |x|² = 2c·x + (r² - |c|²).

use nalgebra::{Matrix3, Vector3};

use super::form::{AxisMotion, GeometricForm, LinearisedDistance, MOST, Second};
use super::linear::{across, axis_of};

/// Centre, unit normal, radius.
#[derive(Clone, Debug)]
pub struct Circle {
    pub centre: Vector3<f64>,
    pub normal: Vector3<f64>,
    pub radius: f64,
}

impl Circle {
    /// Initial circle in the plane through 0 with this normal; `None` if the points lie on a line. The points are centred at 0 and scaled
    /// to size 1.
    pub fn initial(points: &[Vector3<f64>], normal: &Vector3<f64>) -> Option<Self> {
        let [e, f] = across(normal);
        let (mut matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
        for x in points {
            let (u, v) = (e.dot(x), f.dot(x));
            let row = Vector3::new(2.0 * u, 2.0 * v, 1.0);
            matrix += row * row.transpose();
            right += row * (u * u + v * v);
        }
        let solution = matrix.cholesky()?.solve(&right);
        let radius = (solution[2] + solution[0].powi(2) + solution[1].powi(2)).sqrt();
        let centre = solution[0] * e + solution[1] * f;
        (radius.is_finite() && radius > 0.0).then_some(Self { centre, normal: *normal, radius })
    }
}

impl GeometricForm for Circle {
    /// Shift of the centre (3), rotations of the normal (2), change of the radius.
    const PARAMETERS: usize = 6;

    fn rows(&self, points: &[Vector3<f64>]) -> Vec<LinearisedDistance> {
        let [e, f] = across(&self.normal);
        let n = self.normal;
        let rows = points.iter().enumerate().flat_map(|(point, x)| {
            let v = x - self.centre;
            let height = n.dot(&v);
            let within = v - height * n;
            let length = within.norm();
            let outwards = if length > 0.0 { within / length } else { e };
            let o = outwards;
            [
                LinearisedDistance {
                    point,
                    distance: height,
                    by_form: [-n.x, -n.y, -n.z, e.dot(&v), f.dot(&v), 0.0],
                    by_point: n,
                },
                LinearisedDistance {
                    point,
                    distance: length - self.radius,
                    by_form: [-o.x, -o.y, -o.z, -height * o.dot(&e), -height * o.dot(&f), -1.0],
                    by_point: o,
                },
            ]
        });
        rows.collect()
    }

    fn second(&self, point: &Vector3<f64>) -> Second {
        let v = point - self.centre;
        let [e, f] = across(&self.normal);
        let shift = |axis| AxisMotion { shift: axis_of(axis), ..AxisMotion::default() };
        let turn = |turn| AxisMotion { turn, ..AxisMotion::default() };
        let motions = [shift(0), shift(1), shift(2), turn(e), turn(f)];
        let height = self.normal.dot(&v);
        let mut second = Second::zeros();
        second.add_height(height, &motions);
        second.add_across((v - height * self.normal).norm() - self.radius, &v, &self.normal, &motions);
        second
    }

    fn moved(&self, step: &[f64; MOST]) -> Self {
        let [e, f] = across(&self.normal);
        Self {
            centre: self.centre + Vector3::new(step[0], step[1], step[2]),
            normal: (self.normal + step[3] * e + step[4] * f).normalize(),
            radius: self.radius + step[5],
        }
    }

    fn anchored(self, _: &Vector3<f64>) -> Self {
        self
    }

    fn distance(&self, point: &Vector3<f64>) -> f64 {
        let v = point - self.centre;
        let height = self.normal.dot(&v);
        let within = (v - height * self.normal).norm() - self.radius;
        // Positive outside the circle; for a point off the plane the sign is that of its in-plane part.
        height.hypot(within).copysign(if within < 0.0 { -1.0 } else { 1.0 })
    }
}
