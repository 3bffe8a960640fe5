//! Signed distance of a point from a fitted form with its derivative by that point and by all points of the form.

use nalgebra::Vector3;

use super::form::{Fitted, Shape};
use super::linear::{Function, Vector, sum};

/// The distance, positive outside or on the side of the normal, and what it depends on; `None` if it has no derivative: of a point
/// on a line, or on a circle.
pub fn deviation(form: &Fitted, point: usize, x: &Vector3<f64>) -> (f64, Option<Function>) {
    let v = x - form.position.value;
    let own = |g: &Vector3<f64>| Vector::of_point(point, *x).along(g);
    let radius = form.radius.as_ref().map_or(0.0, |(r, _)| *r);
    let by_radius: &[_] = form.radius.as_ref().map_or(&[], |(_, by)| std::slice::from_ref(by));
    let n = form.direction.as_ref();
    let unit = |v: Vector3<f64>| Some(v.norm()).filter(|length| *length > 0.0).map(|length| v / length);
    // d = e·(x - p) - height e·n - r, with e and the height held: the part that turns e has no first order.
    let from_axis = |e: &Vector3<f64>, height: f64, by_radius: &[Function]| {
        let mut parts = vec![(1.0, own(e)), (-1.0, form.position.along(e))];
        parts.extend(n.map(|n| (-height, n.along(e))));
        parts.extend(by_radius.iter().map(|by| (-1.0, by.clone())));
        sum(parts.iter().map(|(factor, f)| (*factor, f)))
    };
    let direction = n.map_or_else(Vector3::zeros, |n| n.value);
    let height = direction.dot(&v);
    let out_of_plane = || {
        let parts = [own(&direction), form.position.along(&direction), n.map(|n| n.along(&v)).unwrap_or_default()];
        sum([(1.0, &parts[0]), (-1.0, &parts[1]), (1.0, &parts[2])])
    };
    let across = v - height * direction;
    match form.shape {
        Shape::Plane => (height, Some(out_of_plane())),
        Shape::Place => (v.norm() - radius, unit(v).map(|e| from_axis(&e, 0.0, by_radius))),
        Shape::Line | Shape::Cylinder => {
            (across.norm() - radius, unit(across).map(|e| from_axis(&e, height, by_radius)))
        }
        Shape::Circle => {
            let within = across.norm() - radius;
            let length = height.hypot(within).copysign(if within < 0.0 { -1.0 } else { 1.0 });
            let function = unit(across).filter(|_| length != 0.0).map(|e| {
                let (a, b) = (out_of_plane(), from_axis(&e, height, by_radius));
                sum([(height / length, &a), (within / length, &b)])
            });
            (length, function)
        }
    }
}
