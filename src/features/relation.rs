//! Distances and angles between points and fitted forms, each with its derivative by all points they come from.

use nalgebra::Vector3;

use super::form::{Fitted, Shape};
use super::linear::{Function, Vector, sum};
use crate::error::{Error, Place, Reason, Result};

/// Directions that differ by less are parallel, as far as the distance of two lines goes: where they come closest is chance then.
const PARALLEL: f64 = 5.0 * std::f64::consts::PI / 180.0;

/// A distance between features, with its derivatives and end points.
pub struct FeatureDistance {
    pub value: f64,
    /// `None` if it is exactly 0.
    pub by: Option<Function>,
    pub ends: [Vector3<f64>; 2],
}

/// Distance between two ends. Of two planes: of the second's centroid from the first; of a line or axis and a plane: of the
/// line's centroid; of lines that are parallel within 5°: of the second's centroid.
pub fn distance(from: &Fitted, to: &Fitted) -> FeatureDistance {
    let (a, b) = (from.shape, to.shape);
    match (a, b) {
        _ if a.is_place() && b.is_place() => between(&from.position, &to.position),
        (Shape::Plane, _) => from_plane(from, &to.position),
        (_, Shape::Plane) => from_plane(to, &from.position).turned(),
        _ if b.is_place() => from_axis(from, &to.position),
        _ if a.is_place() => from_axis(to, &from.position).turned(),
        _ => between_axes(from, to),
    }
}

impl FeatureDistance {
    fn turned(self) -> Self {
        let [a, b] = self.ends;
        Self { ends: [b, a], ..self }
    }
}

fn between(p: &Vector, q: &Vector) -> FeatureDistance {
    let v = q.value - p.value;
    let length = v.norm();
    let by = (length > 0.0).then(|| {
        let e = v / length;
        sum([(1.0, &q.along(&e)), (-1.0, &p.along(&e))])
    });
    FeatureDistance { value: length, by, ends: [p.value, q.value] }
}

fn direction(form: &Fitted) -> Vector {
    form.direction.clone().unwrap_or_default()
}

fn from_plane(plane: &Fitted, place: &Vector) -> FeatureDistance {
    let n = direction(plane);
    let v = place.value - plane.position.value;
    let height = n.value.dot(&v);
    let sign = if height < 0.0 { -1.0 } else { 1.0 };
    let by = sum([(sign, &place.along(&n.value)), (-sign, &plane.position.along(&n.value)), (sign, &n.along(&v))]);
    FeatureDistance { value: height.abs(), by: Some(by), ends: [place.value - height * n.value, place.value] }
}

fn from_axis(axis: &Fitted, place: &Vector) -> FeatureDistance {
    let a = direction(axis);
    let v = place.value - axis.position.value;
    let along = a.value.dot(&v);
    let across = v - along * a.value;
    let length = across.norm();
    let by = (length > 0.0).then(|| {
        let e = across / length;
        sum([(1.0, &place.along(&e)), (-1.0, &axis.position.along(&e)), (-along, &a.along(&e))])
    });
    FeatureDistance { value: length, by, ends: [place.value - across, place.value] }
}

/// d m = (q + t b) - (p + s a) with m across both; the feet s and t have no part in the first order.
fn between_axes(from: &Fitted, to: &Fitted) -> FeatureDistance {
    let (a, b) = (direction(from), direction(to));
    let m = a.value.cross(&b.value);
    if m.norm() < PARALLEL.sin() {
        return from_axis(from, &to.position);
    }
    let m = m.normalize();
    let v = to.position.value - from.position.value;
    let cosine = a.value.dot(&b.value);
    let sine = 1.0 - cosine * cosine;
    let (va, vb) = (v.dot(&a.value), v.dot(&b.value));
    let (s, t) = ((va - cosine * vb) / sine, (cosine * va - vb) / sine);
    let height = v.dot(&m);
    let sign = if height < 0.0 { -1.0 } else { 1.0 };
    let by = sum([
        (sign, &to.position.along(&m)),
        (-sign, &from.position.along(&m)),
        (sign * t, &b.along(&m)),
        (-sign * s, &a.along(&m)),
    ]);
    let ends = [from.position.value + s * a.value, to.position.value + t * b.value];
    FeatureDistance { value: height.abs(), by: Some(by), ends }
}

/// Angle at a place between two others, 0 to π; radians, with what it depends on, none at 0 and π.
///
/// # Errors
/// [`Reason::FeatureUndetermined`] if two of the places are one.
pub fn angle_at(at: &Fitted, from: &Fitted, to: &Fitted) -> Result<(f64, Option<Function>)> {
    let side = |end: &Fitted| {
        let by = std::array::from_fn(|k| sum([(1.0, &end.position.by[k]), (-1.0, &at.position.by[k])]));
        Vector { value: end.position.value - at.position.value, by }
    };
    let (u, w) = (side(from), side(to));
    if !(u.value.norm() > 0.0 && w.value.norm() > 0.0) {
        return Err(Error::Invalid { reason: Reason::FeatureUndetermined, at: Place::default() });
    }
    Ok(between_directions(&u, &w))
}

/// Angle between two directions, 0 to π/2.
///
/// # Errors
/// [`Reason::FeatureNoDirection`] if one has none.
pub fn angle(from: &Fitted, to: &Fitted) -> Result<(f64, Option<Function>)> {
    let (Some(u), Some(w)) = (&from.direction, &to.direction) else {
        return Err(Error::Invalid { reason: Reason::FeatureNoDirection, at: Place::default() });
    };
    let same = if u.value.dot(&w.value) < 0.0 { -1.0 } else { 1.0 };
    let w = Vector { value: same * w.value, by: std::array::from_fn(|k| sum([(same, &w.by[k])])) };
    Ok(between_directions(u, &w))
}

/// θ = atan2(|u × w|, u·w); turning one side towards the other in their plane makes it less.
fn between_directions(u: &Vector, w: &Vector) -> (f64, Option<Function>) {
    let (lu, lw) = (u.value.norm(), w.value.norm());
    let (eu, ew) = (u.value / lu, w.value / lw);
    let value = eu.cross(&ew).norm().atan2(eu.dot(&ew));
    let (towards_w, towards_u) = (ew - eu.dot(&ew) * eu, eu - eu.dot(&ew) * ew);
    // Below this the plane of the two is rounding.
    if !(towards_w.norm() > 1e-12) {
        return (value, None);
    }
    let by = sum([(-1.0 / lu, &u.along(&towards_w.normalize())), (-1.0 / lw, &w.along(&towards_u.normalize()))]);
    (value, Some(by))
}
