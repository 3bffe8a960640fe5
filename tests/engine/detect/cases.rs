//! Small pictures that were wrong once, with their right answers.

use crate::support::data::data;
use crate::support::extent;
use crate::support::painter::{Canvas, Spot, Uniform};
use sightline::decode;
use sightline::detect::{detect, detect_photo, measure_in_photo};
use sightline::detection::{DetectOptions, Detection, Target};
use sightline::noise::Noise;

fn found(name: &str, options: &DetectOptions) -> Option<Detection> {
    let bytes = data(&format!("cases/{name}"))?;
    let photo = decode::photo(&bytes, options.channel).expect("a photo");
    Some(detect_photo(&photo, options).expect("valid options"))
}

#[test]
fn the_full_page_behind_a_thumbnail_and_planar_tiles_are_measured() {
    if let Some(detection) = found("thumbnail_first.tif", &DetectOptions::default()) {
        let page = detection.page.expect("a file of several pictures");
        assert_eq!((page.number, page.skipped), (2, 1));
        assert_eq!(detection.targets.len(), 35);
    }
    for _ in 0..2 {
        if let Some(detection) = found("tiled_planar.tif", &DetectOptions::default()) {
            assert!(detection.width > 0);
        }
    }
}

/// Squared errors over their variances, and how many there are, of the targets that are one of the spots; with the number of the others.
fn errors(detection: &Detection, spots: &[Spot]) -> (f64, usize, usize) {
    let (mut sum, mut count, mut others) = (0.0, 0, 0);
    for Target { u, v, sigma_u, sigma_v, .. } in &detection.targets {
        match spots.iter().find(|spot| (spot.u - u).hypot(spot.v - v) < 1.5) {
            Some(spot) => {
                sum += ((spot.u - u) / sigma_u).powi(2) + ((spot.v - v) / sigma_v).powi(2);
                count += 1;
            }
            None => others += 1,
        }
    }
    (sum, count, others)
}

/// Dots of one size on a grid, a little off it.
fn grid(random: &mut Uniform, a: f64, least_ratio: f64, contrast: f64, [width, height]: [usize; 2]) -> Vec<Spot> {
    let pitch = (3.4 * a).max(45.0);
    let places = |size: usize| (0..(size as f64 / pitch) as usize).map(move |k| (k as f64 + 0.5) * pitch);
    let mut spots = Vec::new();
    for (u, v) in places(width).flat_map(|u| places(height).map(move |v| (u, v))) {
        let [u, v] = [u, v].map(|place| place + random.within(-2.0, 2.0));
        let b = a * random.within(least_ratio, 1.0);
        spots.push(Spot { u, v, a, b, angle: random.within(0.0, 3.1), contrast });
    }
    spots
}

/// Noise shared by neighbours, of variance 1.
fn shared_noise(seed: u64, [width, height]: [usize; 2], reach: f64) -> Vec<f64> {
    let mut source = Noise::new(seed, 0);
    let white: Vec<f64> = (0..width * height).map(|_| source.normal()).collect();
    let half = (3.0 * reach).ceil() as i64;
    let weights: Vec<f64> = (-half..=half).map(|k| (-0.5 * (k as f64 / reach).powi(2)).exp()).collect();
    let norm = weights.iter().map(|w| w * w).sum::<f64>();
    let at = |x: i64, size: usize| x.rem_euclid(size as i64) as usize;
    let along = |from: &[f64], dx: i64, dy: i64| -> Vec<f64> {
        (0..width * height)
            .map(|k| {
                let (x, y) = ((k % width) as i64, (k / width) as i64);
                let place = |n: i64| at(y + n * dy, height) * width + at(x + n * dx, width);
                (-half..=half).zip(&weights).map(|(n, w)| w * from[place(n)]).sum::<f64>()
            })
            .collect()
    };
    along(&along(&white, 1, 0), 0, 1).iter().map(|value| value / norm).collect()
}

#[test]
fn rims_with_more_noise_than_the_ground_are_measured() {
    let options = DetectOptions::default();
    if let Some(detection) = found("edge_noise.png", &options) {
        assert!(detection.targets.len() >= 33 && detection.targets.len() <= 35, "{}", detection.targets.len());
        let photo = decode::photo(&data("cases/edge_noise.png").expect("a file"), options.channel).expect("a photo");
        for Target { u, v, .. } in &detection.targets {
            assert!(measure_in_photo(&photo, *u, *v, &options).expect("a place in the photo").is_some(), "{u} {v}");
        }
    }
    let size = [480, 400];
    let (mut all, mut sum, mut count) = (0, 0.0, 0);
    for seed in 0..extent::cases(6, 40) as u64 {
        let mut random = Uniform(seed);
        let a = random.within(6.0, 16.0);
        let contrast = random.within(-170.0, -80.0);
        let spots = grid(&mut random, a, 0.6, contrast, size);
        let mut canvas = Canvas::new(size[0], size[1], 205.0);
        let blur = random.within(0.7, 1.2);
        spots.iter().for_each(|spot| canvas.add(spot, blur));
        let (most, reach) = (random.within(0.02, 0.055) * -contrast, random.within(0.6, 1.1));
        let near_rims: Vec<f64> = (0..size[0] * size[1])
            .map(|k| {
                let (x, y) = ((k % size[0]) as f64 + 0.5, (k / size[0]) as f64 + 0.5);
                let distance = |spot: &Spot| {
                    let (s, c) = spot.angle.sin_cos();
                    let (dx, dy) = (x - spot.u, y - spot.v);
                    (((c * dx + s * dy) / spot.a).hypot((c * dy - s * dx) / spot.b) - 1.0).abs() * spot.b
                };
                let nearest = spots.iter().map(distance).fold(f64::INFINITY, f64::min);
                most * (1.0 - (nearest - 3.0) / 3.0).clamp(0.0, 1.0)
            })
            .collect();
        let noise = shared_noise(seed + 1000, size, reach);
        for ((level, noise), near) in canvas.levels.iter_mut().zip(noise).zip(near_rims) {
            *level += near * noise;
        }
        let detection = detect(&canvas.expose(random.within(0.6, 1.4), seed).view().expect("a picture"), &options)
            .expect("valid options");
        let (squares, found, others) = errors(&detection, &spots);
        assert_eq!(others, 0, "picture {seed}");
        all += spots.len();
        (sum, count) = (sum + squares, count + found);
    }
    let ratio = (sum / (2 * count) as f64).sqrt();
    println!("{count} of {all} dots, error over sigma {ratio:.2}");
    assert!(count as f64 >= 0.95 * all as f64, "{count} of {all}");
    assert!((0.8..1.3).contains(&ratio), "{ratio}");
}

#[test]
fn rims_that_are_no_ellipses_are_measured_with_what_that_does() {
    if let Some(detection) = found("slightly_out_of_round.png", &DetectOptions::default()) {
        assert_eq!(detection.targets.len(), 5);
        assert!(detection.targets.iter().all(|target| target.quality.occluded == 0.0));
    }
    let size = [480, 400];
    let (mut all, mut sum, mut count) = (0, 0.0, 0);
    for seed in 0..extent::cases(10, 60) as u64 {
        let mut random = Uniform(seed + 7);
        let (a, contrast) = (random.within(9.0, 40.0), random.within(-170.0, -60.0));
        let spots = grid(&mut random, a, 0.75, contrast, size);
        let mut canvas = Canvas::new(size[0], size[1], 205.0);
        let blur = random.within(0.6, 1.4);
        let (waves, amount) = (random.within(2.0, 6.99).floor(), random.within(0.002, 0.012));
        spots.iter().for_each(|spot| canvas.add_wavy(spot, blur, waves, amount, random.within(0.0, 6.3)));
        let noise = random.within(0.5, 2.5);
        let detection = detect(&canvas.expose(noise, seed).view().expect("a picture"), &DetectOptions::default())
            .expect("valid options");
        let (squares, found, others) = errors(&detection, &spots);
        println!(
            "{waves} waves of {:.2} px at {a:.0} px, noise {noise:.1}: {found} of {}, {:.2}",
            amount * a,
            spots.len(),
            (squares / (2 * found.max(1)) as f64).sqrt()
        );
        assert_eq!((found, others), (spots.len(), 0), "picture {seed}");
        all += spots.len();
        (sum, count) = (sum + squares, count + found);
    }
    let ratio = (sum / (2 * count) as f64).sqrt();
    println!("{count} of {all} dots, error over sigma {ratio:.2}");
    assert!(ratio < 1.3, "{ratio}");
}
