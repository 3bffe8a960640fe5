//! Code shared by the fitted forms: rows of distances with their derivatives, and the result of a fit.

use nalgebra::{Matrix6, Vector3};

use super::linear::{Function, Vector};

/// Maximum number of parameters of a form.
pub const MOST: usize = 6;

/// Distance of a point from a form, linearised.
#[derive(Clone, Copy, Debug)]
pub struct LinearisedDistance {
    /// Number of the point in the list that is fitted.
    pub point: usize,
    /// Distance, or one of its components.
    pub distance: f64,
    /// By the form's parameters.
    pub by_form: [f64; MOST],
    /// By the point's coordinates.
    pub by_point: Vector3<f64>,
}

/// What the second derivatives of a point's distances add to the equations: Σ d ∂²d over its rows. Of a round form that the points
/// hardly bend around it is as large as the first derivatives' part, and standard errors without it are wrong.
#[derive(Clone, Copy, Debug)]
pub struct Second {
    /// By the form's parameters, twice.
    pub by_form: Matrix6<f64>,
    /// By the form's parameters and the point's coordinates.
    pub by_point: [Vector3<f64>; MOST],
}

/// How a parameter of a form about an axis moves it: the axis by `shift`, its direction by `turn` across it.
#[derive(Clone, Copy, Debug, Default)]
pub struct AxisMotion {
    /// Of the position.
    pub shift: Vector3<f64>,
    /// Of the direction.
    pub turn: Vector3<f64>,
}

impl Second {
    /// Nothing.
    pub fn zeros() -> Self {
        Self { by_form: Matrix6::zeros(), by_point: [Vector3::zeros(); MOST] }
    }

    /// Of d = |u| - r, u the part of v = x - p across the axis a. With o = u/|u|, m across a and o, s = a·v, and for every
    /// parameter q = shift across a + s·turn, τ = a·shift:
    /// ∂²d = (m·q)(m·q')/|u| - |u|(o·turn)(o·turn') + τ(o·turn') + τ'(o·turn); a point moves like a shift the other way.
    pub fn add_across(&mut self, distance: f64, v: &Vector3<f64>, a: &Vector3<f64>, motions: &[AxisMotion]) {
        let s = a.dot(v);
        let u = v - s * a;
        let length = u.norm();
        if !(length > 0.0) {
            return;
        }
        let o = u / length;
        let m = a.cross(&o);
        for (k, one) in motions.iter().enumerate() {
            let q = m.dot(&(one.shift + s * one.turn)) / length;
            self.by_point[k] -= distance * (q * m + o.dot(&one.turn) * a);
            for (l, other) in motions.iter().enumerate() {
                self.by_form[(k, l)] += distance
                    * (q * m.dot(&(other.shift + s * other.turn)) - length * o.dot(&one.turn) * o.dot(&other.turn)
                        + a.dot(&one.shift) * o.dot(&other.turn)
                        + a.dot(&other.shift) * o.dot(&one.turn));
            }
        }
    }

    /// Of the height h = a·(x - p): ∂²h = -turn·shift' - turn'·shift - h turn·turn'.
    pub fn add_height(&mut self, height: f64, motions: &[AxisMotion]) {
        for (k, one) in motions.iter().enumerate() {
            self.by_point[k] += height * one.turn;
            for (l, other) in motions.iter().enumerate() {
                self.by_form[(k, l)] -= height
                    * (one.turn.dot(&other.shift) + other.turn.dot(&one.shift) + height * one.turn.dot(&other.turn));
            }
        }
    }
}

/// A form that is fitted to points. Its parameters are small changes of the present form, so that no attitude is singular.
pub trait GeometricForm: Clone {
    /// Number of parameters.
    const PARAMETERS: usize;
    /// Linearised distances of the points, one row or two a point.
    fn rows(&self, points: &[Vector3<f64>]) -> Vec<LinearisedDistance>;
    /// Contribution of the second derivatives of a point's distances.
    fn second(&self, point: &Vector3<f64>) -> Second;
    /// The form after a step.
    fn moved(&self, step: &[f64; MOST]) -> Self;
    /// The same form, told about the foot of the points' centroid.
    fn anchored(self, centroid: &Vector3<f64>) -> Self;
    /// Signed distance of a point.
    fn distance(&self, point: &Vector3<f64>) -> f64;
}

/// A form with what its figures depend on.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// Centre, or foot of the centroid.
    pub position: Vector,
    /// Unit direction or normal.
    pub direction: Option<Vector>,
    /// Radius.
    pub radius: Option<(f64, Function)>,
    /// Meaning of distances from it.
    pub shape: Shape,
    /// Signed distances of its own points, in their order.
    pub residuals: Vec<f64>,
}

/// Kinds of forms, as far as distances between them go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Points; centres of spheres.
    Place,
    /// A centre with a normal.
    Circle,
    /// A line.
    Line,
    /// An axis with a radius.
    Cylinder,
    /// A plane.
    Plane,
}

impl Shape {
    /// Whether it lies along its direction.
    pub fn is_axis(self) -> bool {
        matches!(self, Self::Line | Self::Cylinder)
    }

    /// Whether distances from it are those from its position.
    pub fn is_place(self) -> bool {
        matches!(self, Self::Place | Self::Circle)
    }
}

#[cfg(test)]
mod tests {
    use super::super::circle::Circle;
    use super::super::cylinder::Cylinder;
    use super::super::line::Line;
    use super::super::plane::Plane;
    use super::super::sphere::Sphere;
    use super::*;
    use crate::initial::robust::{generator, uniform};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    const H: f64 = 1e-4;

    fn cost<F: GeometricForm>(form: &F, x: &Vector3<f64>) -> f64 {
        form.rows(&[*x]).iter().map(|row| row.distance * row.distance / 2.0).sum()
    }

    /// Half the squared distance by difference quotients against its derivatives: of the form, and of form and point.
    fn check<F: GeometricForm>(form: &F, x: &Vector3<f64>, name: &str) {
        let (rows, second) = (form.rows(&[*x]), form.second(x));
        let size = 1.0 + x.norm_squared();
        let moved = |steps: &[(usize, f64)]| {
            let mut step = [0.0; MOST];
            steps.iter().for_each(|(k, h)| step[*k] += h);
            form.moved(&step)
        };
        let mixed = |f: &dyn Fn(f64, f64) -> f64| (f(H, H) - f(H, -H) - f(-H, H) + f(-H, -H)) / (4.0 * H * H);
        for i in 0..F::PARAMETERS {
            for j in 0..F::PARAMETERS {
                let numeric = mixed(&|a, b| cost(&moved(&[(i, a), (j, b)]), x));
                let analytic = rows.iter().map(|r| r.by_form[i] * r.by_form[j]).sum::<f64>() + second.by_form[(i, j)];
                assert!((numeric - analytic).abs() < 1e-6 * size, "{name} {i} {j}: {numeric} {analytic}");
            }
            for axis in 0..3 {
                let shift = |h: f64| x + Vector3::from_fn(|k, _| if k == axis { h } else { 0.0 });
                let numeric = mixed(&|a, b| cost(&moved(&[(i, a)]), &shift(b)));
                let analytic =
                    rows.iter().map(|r| r.by_form[i] * r.by_point[axis]).sum::<f64>() + second.by_point[i][axis];
                assert!((numeric - analytic).abs() < 1e-6 * size, "{name} {i}, axis {axis}: {numeric} {analytic}");
            }
        }
    }

    #[test]
    fn second_derivatives_are_those_of_difference_quotients() {
        let mut g = generator(3);
        let mut vector = || Vector3::from_fn(|_, _| 2.0 * uniform(&mut g) - 1.0);
        for _ in 0..50 {
            let (position, direction, x) = (vector(), vector().normalize(), vector() * 3.0);
            let radius = 0.2 + vector().norm();
            let axis = Line { position, direction };
            check(&axis, &x, "line");
            check(&Plane { position, normal: direction }, &x, "plane");
            // About a point on the axis no second derivative exists.
            if axis.distance(&x) > 0.2 {
                check(&Cylinder { axis, radius }, &x, "cylinder");
                check(&Circle { centre: position, normal: direction, radius }, &x, "circle");
                check(&Sphere { centre: position, radius }, &x, "sphere");
            }
        }
    }
}
