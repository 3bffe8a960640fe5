//! Parameters of an ellipse that are not singular for a circle.
//!
//! The rim is e(t) = centre + A (cos t, sin t)' with a symmetric positive matrix A = [[p, r], [r, q]]: its eigenvalues are
//! the semi-axes, its first eigenvector is the direction of the major axis. For a circle the angle of the axes is
//! undefined, but p, q and r are not, so least squares in (u, v, p, q, r) always has full rank.

/// Centre (pixels) and the matrix of the semi-axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Outline {
    pub u: f64,
    pub v: f64,
    pub p: f64,
    pub q: f64,
    pub r: f64,
}

/// A point of the rim, its outward unit normal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RimPoint {
    pub x: f64,
    pub y: f64,
    pub normal: [f64; 2],
    /// Derivative of the distance along the normal after (u, v, p, q, r).
    pub moves: [f64; 5],
}

impl Outline {
    /// From semi-axes and the angle of the first one, from u towards v.
    pub fn from_axes(u: f64, v: f64, a: f64, b: f64, angle: f64) -> Self {
        let (s, c) = angle.sin_cos();
        Self { u, v, p: a * c * c + b * s * s, q: a * s * s + b * c * c, r: (a - b) * s * c }
    }

    /// From its centre and A A' = [[m11, m12], [m12, m22]], whose square root A is.
    pub fn of_matrix(u: f64, v: f64, m11: f64, m12: f64, m22: f64) -> Self {
        let root = (m11 * m22 - m12 * m12).sqrt();
        let norm = (m11 + m22 + 2.0 * root).sqrt();
        Self { u, v, p: (m11 + root) / norm, q: (m22 + root) / norm, r: m12 / norm }
    }

    /// Semi-axes, the larger first.
    pub fn semi_axes(&self) -> (f64, f64) {
        let mean = (self.p + self.q) / 2.0;
        let half = (self.p - self.q) / 2.0;
        let spread = (half * half + self.r * self.r).sqrt();
        (mean + spread, mean - spread)
    }

    /// Semi-axes (the larger first) and the angle of the major one, from -90 to 90 degrees.
    pub fn axes(&self) -> (f64, f64, f64) {
        let (a, b) = self.semi_axes();
        (a, b, 0.5 * self.r.atan2((self.p - self.q) / 2.0))
    }

    /// A proper ellipse of finite numbers.
    pub fn is_proper(&self) -> bool {
        let (a, b) = self.semi_axes();
        self.u.is_finite() && self.v.is_finite() && a.is_finite() && b > 0.0
    }

    /// Perimeter in pixels (Ramanujan).
    pub fn perimeter(&self) -> f64 {
        let (a, b) = self.semi_axes();
        std::f64::consts::PI * (3.0 * (a + b) - ((3.0 * a + b) * (a + 3.0 * b)).sqrt())
    }

    /// Half the width and half the height of the upright box around the ellipse.
    pub fn half_box(&self) -> (f64, f64) {
        ((self.p * self.p + self.r * self.r).sqrt(), (self.q * self.q + self.r * self.r).sqrt())
    }

    /// Point of the circle that maps to the given place: length 1 on the rim, less inside.
    #[inline]
    pub fn normalised(&self, x: f64, y: f64) -> [f64; 2] {
        let det = self.p * self.q - self.r * self.r;
        let (x, y) = (x - self.u, y - self.v);
        [(self.q * x - self.r * y) / det, (self.p * y - self.r * x) / det]
    }

    /// The rim at parameter t, given as cosine and sine.
    #[inline]
    pub fn rim(&self, c: f64, s: f64) -> RimPoint {
        let [dx, dy] = [-self.p * s + self.r * c, -self.r * s + self.q * c];
        let speed = (dx * dx + dy * dy).sqrt();
        let scale = 1.0 / speed;
        let normal = [dy * scale, -dx * scale];
        let [nx, ny] = normal;
        RimPoint {
            x: self.u + self.p * c + self.r * s,
            y: self.v + self.r * c + self.q * s,
            normal,
            moves: [nx, ny, nx * c, ny * s, nx * s + ny * c],
        }
    }

    /// Curvature of the rim next to a place near it: det A / |de/dt|³.
    pub fn curvature(&self, x: f64, y: f64) -> f64 {
        let [c, s] = self.normalised(x, y);
        let (du, dv) = (self.r * c - self.p * s, self.q * c - self.r * s);
        let (square, speed) = (c * c + s * s, (du * du + dv * dv).sqrt());
        (self.p * self.q - self.r * self.r) * square * square.sqrt() / (speed * speed * speed).max(1e-12)
    }

    /// Rim point next to a place near the rim, and the signed distance along its normal (outside positive): the rim point
    /// of the same parameter, whose tangent differs from the nearest one's by the second order of the distance.
    #[inline]
    pub fn nearest(&self, x: f64, y: f64) -> (RimPoint, f64) {
        let [c, s] = self.normalised(x, y);
        let square = c * c + s * s;
        let scale = if square > 1e-24 { 1.0 / square.sqrt() } else { 1e12 };
        let rim = self.rim(c * scale, s * scale);
        let distance = (x - rim.x) * rim.normal[0] + (y - rim.y) * rim.normal[1];
        (rim, distance)
    }

    /// Distance of a place from the rim to first order (Sampson), for places near it; outside positive.
    #[inline]
    pub fn distance(&self, x: f64, y: f64) -> f64 {
        let scale = 1.0 / (self.p * self.q - self.r * self.r);
        let (x, y) = (x - self.u, y - self.v);
        let (c, s) = (scale * (self.q * x - self.r * y), scale * (self.p * y - self.r * x));
        let (gx, gy) = (scale * (self.q * c - self.r * s), scale * (self.p * s - self.r * c));
        let square = c * c + s * s;
        if square > 0.0 { (square - square.sqrt()) / (gx * gx + gy * gy).sqrt() } else { -self.semi_axes().1 }
    }

    /// Largest difference of u, v, p, q and r, in pixels.
    pub fn differs(&self, other: &Self) -> f64 {
        let differences = [self.u - other.u, self.v - other.v, self.p - other.p, self.q - other.q, self.r - other.r];
        differences.iter().fold(0.0, |largest, d| if d.abs() > largest { d.abs() } else { largest })
    }

    /// Moved and reshaped by a correction of (u, v, p, q, r).
    pub fn plus(&self, d: &[f64]) -> Self {
        Self { u: self.u + d[0], v: self.v + d[1], p: self.p + d[2], q: self.q + d[3], r: self.r + d[4] }
    }

    /// Semi-axes longer by `pixels` (both), at least a thousandth.
    pub fn grown(&self, pixels: f64) -> Self {
        if self.semi_axes().1 + pixels > 1e-3 {
            return Self { p: self.p + pixels, q: self.q + pixels, ..*self };
        }
        let (a, b, angle) = self.axes();
        Self::from_axes(self.u, self.v, (a + pixels).max(1e-3), (b + pixels).max(1e-3), angle)
    }

    /// Semi-axes times a factor.
    pub fn scaled(&self, factor: f64) -> Self {
        Self { p: self.p * factor, q: self.q * factor, r: self.r * factor, ..*self }
    }

    /// Columns (as real numbers) where the horizontal line at height `y` enters and leaves the ellipse.
    pub fn chord(&self, y: f64) -> Option<(f64, f64)> {
        // x' (A A')^-1 x = 1 with A A' = [[m11, m12], [m12, m22]]
        let m11 = self.p * self.p + self.r * self.r;
        let m12 = self.r * (self.p + self.q);
        let m22 = self.q * self.q + self.r * self.r;
        let dy = y - self.v;
        let rest = m22 - dy * dy;
        if rest <= 0.0 || m22 <= 0.0 {
            return None;
        }
        let middle = self.u + m12 / m22 * dy;
        let half = ((m11 * m22 - m12 * m12).max(0.0) * rest).sqrt() / m22;
        Some((middle - half, middle + half))
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    const TILTED: (f64, f64, f64, f64, f64) = (40.0, 30.0, 12.0, 5.0, 0.6);

    fn tilted() -> Outline {
        let (u, v, a, b, angle) = TILTED;
        Outline::from_axes(u, v, a, b, angle)
    }

    #[test]
    fn axes_come_back() {
        let (a, b, angle) = tilted().axes();
        assert!((a - 12.0).abs() < 1e-12 && (b - 5.0).abs() < 1e-12 && (angle - 0.6).abs() < 1e-12);
    }

    #[test]
    fn the_chord_ends_on_the_rim() {
        let outline = tilted();
        let (left, right) = outline.chord(33.0).unwrap();
        for x in [left, right] {
            let [c, s] = outline.normalised(x, 33.0);
            assert!((c.hypot(s) - 1.0).abs() < 1e-12);
        }
        assert!(outline.chord(30.0 + outline.half_box().1 + 1e-6).is_none());
        assert!(outline.chord(30.0 + outline.half_box().1 - 1e-6).is_some());
    }

    #[test]
    fn distances_along_the_normal_come_back() {
        let outline = tilted();
        for k in 0..40 {
            let (s, c) = (f64::from(k) * 0.157).sin_cos();
            let rim = outline.rim(c, s);
            for distance in [-0.1, 0.1] {
                let place = [rim.x + distance * rim.normal[0], rim.y + distance * rim.normal[1]];
                let (_, found) = outline.nearest(place[0], place[1]);
                assert!((found - distance).abs() < 5e-3, "{k} {found}");
                assert!((outline.distance(place[0], place[1]) - distance).abs() < 5e-3);
            }
        }
    }

    #[test]
    fn moves_are_the_derivatives_of_the_distance_along_the_normal() {
        let outline = tilted();
        let rim = outline.rim(0.6, 0.8);
        for i in 0..5 {
            let mut d = [0.0; 5];
            d[i] = 1e-6;
            let moved = outline.plus(&d).rim(0.6, 0.8);
            let along = (moved.x - rim.x) * rim.normal[0] + (moved.y - rim.y) * rim.normal[1];
            assert!((along / 1e-6 - rim.moves[i]).abs() < 1e-6);
        }
    }
}
