//! Drawing of a measured feature: its outline as line segments, and the surface of its points as triangles.
//!
//! Forms end at their points: a plane at their convex hull, an axis at the outermost points.

use nalgebra::Vector3;

use crate::adjustment::MeasuredFeature;

/// Number of segments of a drawn circle.
const ROUND: usize = 72;
/// Number of bands of a drawn sphere from pole to pole.
const BANDS: usize = 24;

/// The drawing of a feature, in the object coordinate system.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawn {
    /// Line segments: circles, edges, lines between end points.
    pub outline: Vec<[[f64; 3]; 2]>,
    /// Triangles of the surface; empty for lines and distances.
    pub surface: Vec<[[f64; 3]; 3]>,
    /// Position of the name.
    pub label: Option<[f64; 3]>,
}

type SpaceVector = Vector3<f64>;

/// The drawing of a feature; `points` are the coordinates of its points.
pub fn drawn(feature: &MeasuredFeature, points: &[[f64; 3]]) -> Drawn {
    let mut drawn = Drawn { label: feature.position, ..Drawn::default() };
    let radius = feature.value.unwrap_or(0.0) / 2.0;
    let (position, direction) = (feature.position.map(SpaceVector::from), feature.direction.map(SpaceVector::from));
    match (feature.kind.as_str(), position, direction) {
        ("circle", Some(centre), Some(n)) => {
            let ring = ring(&centre, &n, radius);
            drawn.surface = fan(&centre, &ring);
            drawn.edge(&ring);
        }
        ("sphere", Some(centre), _) => {
            for n in [SpaceVector::x(), SpaceVector::y(), SpaceVector::z()] {
                drawn.edge(&ring(&centre, &n, radius));
            }
            drawn.surface = sphere(&centre, radius);
        }
        ("cylinder", _, Some(n)) => drawn.cylinder(feature, &n, radius),
        ("plane", Some(p), Some(n)) => {
            let [e, f] = across(&n);
            let inside = points.iter().map(|x| SpaceVector::from(*x) - p).map(|v| [v.dot(&e), v.dot(&f)]);
            let corners: Vec<SpaceVector> =
                hull(inside.collect()).into_iter().map(|[a, b]| p + a * e + b * f).collect();
            drawn.edge(&corners);
            drawn.surface = fan(&p, &corners);
            drawn.label = corners.first().map(|c| (*c).into()).or(drawn.label);
        }
        _ => {
            drawn.outline = feature.ends.windows(2).map(|pair| [pair[0], pair[1]]).collect();
            if let (Some(first), Some(last)) = (feature.ends.first(), feature.ends.last()) {
                drawn.label = Some(std::array::from_fn(|k| (first[k] + last[k]) / 2.0));
            }
        }
    }
    drawn
}

impl Drawn {
    /// A closed edge.
    fn edge(&mut self, corners: &[SpaceVector]) {
        self.outline.extend(around(corners).map(|(a, b)| [a.into(), b.into()]));
    }

    fn cylinder(&mut self, feature: &MeasuredFeature, n: &SpaceVector, radius: f64) {
        let &[from, to] = &feature.ends[..] else { return };
        let (foot, head) = (ring(&from.into(), n, radius), ring(&to.into(), n, radius));
        self.edge(&foot);
        self.edge(&head);
        self.outline.push([from, to]);
        let quarters = (0..4).map(|k| k * ROUND / 4);
        self.outline.extend(quarters.map(|k| [foot[k].into(), head[k].into()]));
        for ((a, b), (c, d)) in around(&foot).zip(around(&head)) {
            self.surface.push([a, b, d].map(Into::into));
            self.surface.push([a, d, c].map(Into::into));
        }
        self.label = Some(to);
    }
}

/// Pairs of neighbouring corners of a closed line.
fn around(corners: &[SpaceVector]) -> impl Iterator<Item = (SpaceVector, SpaceVector)> + '_ {
    corners.iter().copied().zip(corners.iter().copied().cycle().skip(1))
}

/// Triangles between a centre and a closed edge.
fn fan(middle: &SpaceVector, edge: &[SpaceVector]) -> Vec<[[f64; 3]; 3]> {
    around(edge).map(|(a, b)| [*middle, a, b].map(Into::into)).collect()
}

/// Two unit vectors perpendicular to `n` and to each other.
fn across(n: &SpaceVector) -> [SpaceVector; 2] {
    let least = n.iamin();
    let e = n.cross(&SpaceVector::from_fn(|k, _| if k == least { 1.0 } else { 0.0 })).normalize();
    [e, n.cross(&e)]
}

fn ring(centre: &SpaceVector, n: &SpaceVector, radius: f64) -> Vec<SpaceVector> {
    let [e, f] = across(n);
    let turn = |k: usize| std::f64::consts::TAU * k as f64 / ROUND as f64;
    (0..ROUND).map(|k| centre + radius * (turn(k).cos() * e + turn(k).sin() * f)).collect()
}

fn sphere(centre: &SpaceVector, radius: f64) -> Vec<[[f64; 3]; 3]> {
    let parallel = |band: usize| {
        let latitude = std::f64::consts::PI * (band as f64 / BANDS as f64 - 0.5);
        ring(&(centre + radius * latitude.sin() * SpaceVector::z()), &SpaceVector::z(), radius * latitude.cos())
    };
    let mut all = Vec::new();
    for band in 0..BANDS {
        let (below, above) = (parallel(band), parallel(band + 1));
        for ((a, b), (c, d)) in around(&below).zip(around(&above)) {
            // At the poles one side of each has no length.
            if band > 0 {
                all.push([a, b, d].map(Into::into));
            }
            if band + 1 < BANDS {
                all.push([a, d, c].map(Into::into));
            }
        }
    }
    all
}

/// Convex hull of points in a plane, counter-clockwise (Andrew's monotone chain).
fn hull(mut all: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    all.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let half = |places: &mut dyn Iterator<Item = &[f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for c in places {
            while let [.., a, b] = chain[..] {
                if (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(*c);
        }
        // Its last place is the first of the other half.
        chain.pop();
        chain
    };
    let mut chain = half(&mut all.iter());
    chain.extend(half(&mut all.iter().rev()));
    chain
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn area(surface: &[[[f64; 3]; 3]]) -> f64 {
        let one = |[a, b, c]: &[[f64; 3]; 3]| {
            let [a, b, c] = [a, b, c].map(|p| SpaceVector::from(*p));
            (b - a).cross(&(c - a)).norm() / 2.0
        };
        surface.iter().map(one).sum()
    }

    fn feature(kind: &str, diameter: Option<f64>) -> MeasuredFeature {
        let n = SpaceVector::new(0.3, -0.5, 0.8).normalize();
        MeasuredFeature {
            kind: kind.into(),
            value: diameter,
            position: Some([10.0, 20.0, 30.0]),
            direction: Some(n.into()),
            ..MeasuredFeature::default()
        }
    }

    #[test]
    fn surfaces_lie_on_their_forms_and_have_their_areas() {
        let centre = SpaceVector::new(10.0, 20.0, 30.0);
        let n = SpaceVector::from(feature("", None).direction.expect("one"));
        let circle = drawn(&feature("circle", Some(4.0)), &[]);
        assert!((area(&circle.surface) / (4.0 * PI) - 1.0).abs() < 0.002, "{}", area(&circle.surface));
        assert_eq!(circle.outline.len(), ROUND);

        let sphere = drawn(&feature("sphere", Some(4.0)), &[]);
        assert!((area(&sphere.surface) / (16.0 * PI) - 1.0).abs() < 0.006, "{}", area(&sphere.surface));
        let off = |p: &[f64; 3]| ((SpaceVector::from(*p) - centre).norm() - 2.0).abs();
        assert!(sphere.surface.iter().flatten().chain(sphere.outline.iter().flatten()).all(|p| off(p) < 1e-12));

        let mut pipe = feature("cylinder", Some(4.0));
        pipe.ends = vec![(centre - 3.0 * n).into(), (centre + 4.0 * n).into()];
        let cylinder = drawn(&pipe, &[]);
        assert!((area(&cylinder.surface) / (28.0 * PI) - 1.0).abs() < 0.001, "{}", area(&cylinder.surface));
        let off = |p: &[f64; 3]| {
            let v = SpaceVector::from(*p) - centre;
            ((v - v.dot(&n) * n).norm() - 2.0).abs()
        };
        assert!(cylinder.surface.iter().flatten().all(|p| off(p) < 1e-12));

        let [e, f] = across(&n);
        let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0], [2.0, 1.0]];
        let points: Vec<[f64; 3]> = corners.map(|[a, b]| (centre + a * e + b * f + 0.1 * n).into()).into();
        let plane = drawn(&feature("plane", None), &points);
        assert!((area(&plane.surface) - 12.0).abs() < 1e-9, "{}", area(&plane.surface));
        assert!(plane.surface.iter().flatten().all(|p| (SpaceVector::from(*p) - centre).dot(&n).abs() < 1e-12));
    }

    #[test]
    fn what_has_no_surface_has_its_lines() {
        let mut distance = feature("distance", Some(5.0));
        (distance.position, distance.ends) = (None, vec![[0.0; 3], [4.0, 0.0, 0.0]]);
        let distance = drawn(&distance, &[]);
        assert_eq!(distance.outline, [[[0.0; 3], [4.0, 0.0, 0.0]]]);
        assert_eq!((distance.surface.len(), distance.label), (0, Some([2.0, 0.0, 0.0])));
        // A cylinder whose ends are not known yet.
        assert_eq!(drawn(&feature("cylinder", Some(4.0)), &[]).surface.len(), 0);
    }

    #[test]
    fn a_plane_is_drawn_around_its_outermost_points() {
        let places = [[0.0, 0.0], [4.0, 0.0], [2.0, 1.0], [4.0, 3.0], [0.0, 3.0], [2.0, 0.0]];
        assert_eq!(hull(places.into()), [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]]);
        assert_eq!(hull(vec![[1.0, 1.0]]).len(), 0);
        assert_eq!(hull(vec![[1.0, 1.0], [0.0, 0.0], [2.0, 2.0]]), [[0.0, 0.0], [2.0, 2.0]]);
    }
}
