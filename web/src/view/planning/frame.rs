//! Where places of the object are in a drawing: seen from above, from two sides, or from anywhere, all without perspective.

use sightline::project::{Plan, Region};

pub const WIDTH: f64 = 640.0;
pub const HEIGHT: f64 = 276.0;
const MARGIN: f64 = 26.0;

/// As far as a place reaches that is forbidden at every height, or every depth of another view.
pub const ENDLESS: f64 = 1e6;

/// From where a drawing is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Look {
    /// X to the right, Y up.
    Top,
    /// X to the right, Z up.
    Front,
    /// Y to the right, Z up.
    Side,
    /// Turned about Z, then tilted, radians.
    Space([f64; 2]),
}

impl Look {
    pub fn name(self) -> &'static str {
        match self {
            Self::Top => "top",
            Self::Front => "front",
            Self::Side => "side",
            Self::Space(_) => "space",
        }
    }

    /// Unit vectors to the right and up.
    fn axes(self) -> [[f64; 3]; 2] {
        match self {
            Self::Top => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            Self::Front => [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
            Self::Side => [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            Self::Space([turn, tilt]) => {
                let ((s, c), (st, ct)) = (turn.sin_cos(), tilt.sin_cos());
                [[c, s, 0.0], [-s * st, c * st, ct]]
            }
        }
    }
}

/// Maps coordinates of the object to the drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawingFrame {
    right: [f64; 3],
    up: [f64; 3],
    middle: [f64; 2],
    /// Units of the drawing in one of length.
    pub scale: f64,
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl DrawingFrame {
    /// Everything of the plan in sight, with some room to move stations in.
    pub fn of(plan: &Plan, look: Look) -> Self {
        let [right, up] = look.axes();
        let points = plan.points.iter().filter_map(|p| p.xyz);
        let regions =
            plan.forbidden.iter().flat_map(|r| [r.low, r.high]).filter(|c| c.iter().all(|x| x.abs() < ENDLESS));
        let all: Vec<[f64; 3]> = points.chain(plan.stations.iter().map(|s| s.position)).chain(regions).collect();
        let extent = |axis: &[f64; 3]| {
            let low = all.iter().map(|p| dot(p, axis)).fold(f64::INFINITY, f64::min);
            let high = all.iter().map(|p| dot(p, axis)).fold(f64::NEG_INFINITY, f64::max);
            if low <= high { (low, high) } else { (-1.0, 1.0) }
        };
        let (across, along) = (extent(&right), extent(&up));
        let size = |(low, high): (f64, f64)| (1.15 * (high - low)).max(1e-9);
        let scale = ((WIDTH - 2.0 * MARGIN) / size(across)).min((HEIGHT - 2.0 * MARGIN) / size(along));
        let middle = [(across.0 + across.1) / 2.0, (along.0 + along.1) / 2.0];
        Self { right, up, middle, scale: scale.min(1e9) }
    }

    pub fn at(&self, xyz: &[f64; 3]) -> [f64; 2] {
        [
            WIDTH / 2.0 + (dot(xyz, &self.right) - self.middle[0]) * self.scale,
            HEIGHT / 2.0 - (dot(xyz, &self.up) - self.middle[1]) * self.scale,
        ]
    }

    /// A direction as it is drawn, x to the right and y down.
    pub fn along(&self, direction: &[f64; 3]) -> [f64; 2] {
        [dot(direction, &self.right), -dot(direction, &self.up)]
    }

    /// A place moved, at its depth, to where it is drawn at.
    pub fn moved(&self, xyz: &[f64; 3], [x, y]: [f64; 2]) -> [f64; 3] {
        let now = self.at(xyz);
        let (du, dv) = ((x - now[0]) / self.scale, (now[1] - y) / self.scale);
        [0, 1, 2].map(|k| {
            let (right, up) = (self.right[k], self.up[k]);
            // What the drawing does not show stays as it was, to the last digit.
            if right == 0.0 && up == 0.0 { xyz[k] } else { rounded(xyz[k] + du * right + dv * up) }
        })
    }

    /// The box between two corners of the drawing, endless along its view; `None` if no axis is seen end on.
    pub fn region(&self, corners: [[f64; 2]; 2]) -> Option<Region> {
        let (right, up) = (axis_of(&self.right)?, axis_of(&self.up)?);
        let mut region = Region { low: [-ENDLESS; 3], high: [ENDLESS; 3] };
        let sides = [
            (right, corners.map(|c| self.middle[0] + (c[0] - WIDTH / 2.0) / self.scale)),
            (up, corners.map(|c| self.middle[1] - (c[1] - HEIGHT / 2.0) / self.scale)),
        ];
        for (k, [a, b]) in sides {
            (region.low[k], region.high[k]) = (rounded(a.min(b)), rounded(a.max(b)));
        }
        Some(region)
    }

    /// Half axes of a covariance's ellipse as it is seen, and the angle of the larger one, clockwise from the right, degrees.
    pub fn ellipse(&self, covariance: &[f64; 6]) -> [f64; 3] {
        let [xx, xy, xz, yy, yz, zz] = *covariance;
        let times = |v: &[f64; 3]| {
            [xx * v[0] + xy * v[1] + xz * v[2], xy * v[0] + yy * v[1] + yz * v[2], xz * v[0] + yz * v[1] + zz * v[2]]
        };
        let (a, b, c) = (
            dot(&times(&self.right), &self.right),
            dot(&times(&self.right), &self.up),
            dot(&times(&self.up), &self.up),
        );
        let (mean, apart) = ((a + c) / 2.0, ((a - c) / 2.0).hypot(b));
        let angle = 0.5 * (2.0 * b).atan2(a - c);
        [(mean + apart).max(0.0).sqrt(), (mean - apart).max(0.0).sqrt(), -angle.to_degrees()]
    }
}

/// The axis of coordinates that a unit vector is.
fn axis_of(vector: &[f64; 3]) -> Option<usize> {
    vector.iter().position(|x| *x == 1.0)
}

/// A coordinate to four digits.
pub fn rounded(value: f64) -> f64 {
    let step = 10f64.powf((value.abs().max(1e-9)).log10().floor() - 3.0);
    let round = (value / step).round() * step;
    // Without the last bits that the step leaves behind, nor a sign on nothing.
    format!("{round:.6e}").parse().unwrap_or(round) + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edit::plan;
    use sightline::project::Project;

    fn planned() -> Plan {
        let mut project = Project::default();
        plan::begin(&mut project, plan::first_form("plane", 1.0), 1.0);
        let mut plan = *project.plan.expect("a plan");
        plan::add_station(&mut plan);
        plan
    }

    #[test]
    fn stations_move_to_where_they_are_dragged() {
        let plan = planned();
        let from = plan.stations[0].position;
        for look in [Look::Top, Look::Front, Look::Side, Look::Space([0.6, 0.4])] {
            let frame = DrawingFrame::of(&plan, look);
            let to = frame.moved(&from, [200.0, 100.0]);
            let [x, y] = frame.at(&to);
            assert!((x - 200.0).abs() < 1.0 && (y - 100.0).abs() < 1.0, "{look:?}: {x} {y}");
        }
        assert_eq!(DrawingFrame::of(&plan, Look::Top).moved(&from, [1.0, 2.0])[2], from[2]);
        assert_eq!(DrawingFrame::of(&plan, Look::Side).moved(&from, [1.0, 2.0])[0], from[0]);
    }

    #[test]
    fn nothing_has_no_sign() {
        assert_eq!(rounded(-3e-13).to_string(), "0");
        assert_eq!(rounded(-1586.04).to_string(), "-1586");
    }

    #[test]
    fn regions_are_endless_along_the_view() {
        let frame = DrawingFrame::of(&planned(), Look::Front);
        let [low, high] = [[-100.0, 0.0, 200.0], [300.0, 0.0, 500.0]].map(|xyz| frame.at(&xyz));
        let region = frame.region([[high[0], low[1]], [low[0], high[1]]]).expect("a region");
        assert_eq!((region.low, region.high), ([-100.0, -ENDLESS, 200.0], [300.0, ENDLESS, 500.0]));
        assert!(DrawingFrame::of(&planned(), Look::Space([0.6, 0.4])).region([[0.0; 2], [9.0; 2]]).is_none());
        // It does not make the drawing small.
        let mut plan = planned();
        plan.forbidden.push(region);
        assert_eq!(DrawingFrame::of(&plan, Look::Front), frame);
    }

    #[test]
    fn ellipses_are_seen_from_their_side() {
        let frame = DrawingFrame::of(&planned(), Look::Front);
        let [large, small, angle] = frame.ellipse(&[9.0, 0.0, 0.0, 100.0, 0.0, 4.0]);
        assert!((large - 3.0).abs() < 1e-12 && (small - 2.0).abs() < 1e-12 && angle.abs() < 1e-9);
        // Along the diagonal from bottom left to top right.
        assert!((frame.ellipse(&[1.0, 0.0, 0.9, 1.0, 0.0, 1.0])[2] + 45.0).abs() < 1e-9);
    }

    #[test]
    fn coordinates_have_four_digits() {
        assert_eq!((rounded(1234.567), rounded(-0.123_456), rounded(0.0)), (1235.0, -0.1235, 0.0));
    }
}
