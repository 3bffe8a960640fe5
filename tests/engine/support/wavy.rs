//! Targets with irregular edges.

use super::painter::{Canvas, Spot};

impl Canvas {
    /// Adds a spot whose rim departs from its ellipse by the part `amount` of its radius, `waves` times around it.
    pub fn add_wavy(&mut self, spot: &Spot, s: f64, waves: f64, amount: f64, phase: f64) {
        let (sine, cosine) = spot.angle.sin_cos();
        let inside = |x: f64, y: f64| {
            let (p, q) = ((cosine * x + sine * y) / spot.a, (cosine * y - sine * x) / spot.b);
            p.hypot(q) < 1.0 + amount * (waves * q.atan2(p) + phase).cos()
        };
        let half = (spot.a.powi(2) * sine * sine + spot.b.powi(2) * cosine * cosine).sqrt() * (1.0 + amount);
        // the middle of the ellipse's chords is inside wherever the row meets the spot in more than a tip
        let lean = sine * cosine * (spot.a.powi(2) - spot.b.powi(2)) / (half / (1.0 + amount)).powi(2);
        let far = spot.a * (1.0 + amount) + spot.b;
        self.sweep(spot, s, half, |dy| {
            let middle = lean * dy;
            let end = |side: f64| {
                let (mut near, mut out) = (0.0, far);
                for _ in 0..40 {
                    let at = 0.5 * (near + out);
                    if inside(middle + side * at, dy) { near = at } else { out = at }
                }
                middle + side * near
            };
            inside(middle, dy).then(|| [end(-1.0), end(1.0)])
        });
    }
}
