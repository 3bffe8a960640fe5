//! Pictures without blur and without noise, as programs draw them.

use sightline::detect::detect;
use sightline::detection::{DetectOptions, Method};
use sightline::image::{GreyView, SamplesView};

/// A bright disc on dark ground, each pixel the mean of 16 x 16 places.
fn disc(width: usize, height: usize, [u, v]: [f64; 2], radius: f64) -> Vec<u8> {
    let inside = |x: usize, y: usize| {
        let place = |i: usize| {
            (x as f64 + ((i % 16) as f64 + 0.5) / 16.0 - u).hypot(y as f64 + ((i / 16) as f64 + 0.5) / 16.0 - v)
        };
        (0..256).filter(|&i| place(i) < radius).count() as f64 / 256.0
    };
    (0..width * height).map(|i| (40.0 + 160.0 * inside(i % width, i / width)).round() as u8).collect()
}

#[test]
fn sharp_discs_are_measured_by_every_method() {
    // What each method can do without the blur that it interpolates on; the gradient then stands on single pixels.
    let methods =
        [(Method::LeastSquares, 0.01), (Method::Ellipse, 0.02), (Method::Intensity, 0.05), (Method::Gradient, 0.2)];
    for radius in [3.4, 5.0, 9.5, 20.0] {
        for (method, tolerance) in methods {
            let samples = disc(80, 60, [41.3, 28.8], radius);
            let view = GreyView::new(80, 60, SamplesView::U8(&samples)).expect("a picture");
            let found = detect(&view, &DetectOptions { method, ..DetectOptions::default() }).expect("valid options");
            assert_eq!(found.targets.len(), 1, "radius {radius}, {method:?}: {:?}", found.rejected);
            let target = &found.targets[0];
            let off = (target.u - 41.3).hypot(target.v - 28.8);
            assert!(off < tolerance, "radius {radius}, {method:?}: off by {off} px");
            assert!((target.major - 2.0 * radius).abs() < 0.2, "radius {radius}, {method:?}: {}", target.major);
        }
    }
}

#[test]
fn edges_that_rise_along_a_straight_line_are_measured() {
    // No lens draws like this, and no noise hides it; the brightest level is no end of the scale.
    for width in [1.0, 1.5, 2.0, 2.5, 3.0] {
        for (ground, spot, radius) in
            [(20.0, 220.0, 5.0), (230.0, 10.0, 10.0), (20.0, 220.0, 20.0), (230.0, 10.0, 40.0)]
        {
            let size = (2.0 * radius) as usize + 60;
            let [u, v] = [size as f64 / 2.0 + 0.3, size as f64 / 2.0 - 0.2];
            let level = |i: usize| {
                let distance = ((i % size) as f64 + 0.5 - u).hypot((i / size) as f64 + 0.5 - v);
                let share: f64 = 0.5 - (distance - radius) / width;
                (ground + (spot - ground) * share.clamp(0.0, 1.0)).round() as u8
            };
            let samples: Vec<u8> = (0..size * size).map(level).collect();
            let view = GreyView::new(size, size, SamplesView::U8(&samples)).expect("a picture");
            let found = detect(&view, &DetectOptions::default()).expect("valid options");
            assert_eq!(found.targets.len(), 1, "ramp {width}, radius {radius}: {:?}", found.rejected);
            let target = &found.targets[0];
            let off = (target.u - u).hypot(target.v - v);
            // the rendered edge is not the drawn one: what is left is in the sigma
            let sigma = target.sigma_u.hypot(target.sigma_v);
            assert!(off < 0.03 && off < 3.0 * sigma, "ramp {width}, radius {radius}: off by {off} px, sigma {sigma}");
        }
    }
}

#[test]
fn discs_of_two_levels_are_found_though_their_edges_are_stairs() {
    for (ground, spot, radius) in [(20, 220, 6.0), (230, 10, 10.0), (0, 255, 25.0), (255, 0, 40.0)] {
        let size = (2.0 * radius) as usize + 60;
        let [u, v] = [size as f64 / 2.0 + 0.3, size as f64 / 2.0 - 0.2];
        let inside = |i: usize| ((i % size) as f64 + 0.5 - u).hypot((i / size) as f64 + 0.5 - v) < radius;
        let samples: Vec<u8> = (0..size * size).map(|i| if inside(i) { spot } else { ground }).collect();
        let view = GreyView::new(size, size, SamplesView::U8(&samples)).expect("a picture");
        let found = detect(&view, &DetectOptions::default()).expect("valid options");
        assert_eq!(found.targets.len(), 1, "radius {radius}: {:?}", found.rejected);
        let target = &found.targets[0];
        let (off, sigma) = ((target.u - u).hypot(target.v - v), target.sigma_u.hypot(target.sigma_v));
        assert!(off < 0.25 && off < 4.0 * sigma, "radius {radius}: off by {off} px, sigma {sigma}");
    }
}
