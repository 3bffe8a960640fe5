//! Donuts: the outer rim is the target, the hole a property of it; both centres are as exact as they say.

use crate::support::donuts::{self, Donut};
use crate::support::extent;
use crate::support::painter::{Canvas, Spot, Uniform};
use sightline::detect::{detect, measure_all, measure_at};
use sightline::detection::{CodeNote, Codes, DetectOptions, Detection, Method, Polarity, PolarityChoice, Target};
use sightline::image::Grey;

fn found(picture: &Grey, options: &DetectOptions) -> Detection {
    detect(&picture.view().expect("a picture"), options).expect("valid options")
}

fn at<'a>(targets: &'a [Target], spot: &Spot) -> Option<&'a Target> {
    targets.iter().find(|target| (target.u - spot.u).hypot(target.v - spot.v) < 2.5)
}

fn square(target: [f64; 2], sigma: [f64; 2], spot: &Spot) -> f64 {
    ((target[0] - spot.u) / sigma[0]).powi(2) + ((target[1] - spot.v) / sigma[1]).powi(2)
}

/// Donuts with their holes up to so many pixels aside: how many, how many are found by their outer rims, rms of error over sigma of both
/// centres, and how many are said to differ.
fn donuts(aside: f64) -> (usize, usize, [f64; 2], usize) {
    let (mut all, mut count, mut squares, mut off) = (0, 0, [0.0; 2], 0);
    for seed in 0..extent::cases(16, 40) as u64 {
        let mut random = Uniform(77 * seed + 3);
        random.next();
        let (canvas, donuts) = donuts::picture(&mut random, aside);
        let detection = found(&canvas.expose(random.within(1.0, 3.0), seed), &DetectOptions::default());
        // none is reported twice, nor anything else
        assert!(detection.targets.len() <= donuts.len(), "picture {seed}");
        for Donut { outer, inner } in &donuts {
            all += 1;
            let Some(target) = at(&detection.targets, outer).filter(|target| target.inner.is_some()) else { continue };
            let hole = target.inner.expect("a hole");
            count += 1;
            assert_eq!(target.polarity == Polarity::Bright, outer.contrast > 0.0);
            assert!((target.major / (2.0 * outer.a) - 1.0).abs() < 0.02, "{outer:?} {target:?}");
            assert!((hole.major / (2.0 * inner.a) - 1.0).abs() < 0.1, "{inner:?} {hole:?}");
            squares[0] += square([target.u, target.v], [target.sigma_u, target.sigma_v], outer);
            squares[1] += square([hole.u, hole.v], [hole.sigma_u, hole.sigma_v], inner);
            off += usize::from(hole.off_centre);
        }
    }
    let ratios = squares.map(|sum| (sum / (2 * count) as f64).sqrt());
    println!("aside {aside}: {count} of {all}, error over sigma {ratios:.2?}, {off} off");
    (all, count, ratios, off)
}

#[test]
fn the_outer_rim_is_the_target_and_the_hole_is_told() {
    let (all, count, ratios, off) = donuts(0.0);
    assert!(100 * count >= 96 * all && off <= all / 100, "{count} of {all}, {off} off");
    assert!(ratios.iter().all(|ratio| (0.85..1.2).contains(ratio)), "{ratios:?}");
    // half of the holes are aside by a pixel and more, forty times what their standard errors are
    let (all, count, ratios, off) = donuts(2.0);
    assert!(100 * count >= 95 * all && 100 * off >= 85 * count, "{count} of {all}, {off} off");
    assert!(ratios.iter().all(|ratio| (0.85..1.25).contains(ratio)), "{ratios:?}");
}

/// Discs of the colour and of the ground in turn about the same centre, from the outermost.
fn nested(canvas: &mut Canvas, spot: Spot, radii: &[f64]) {
    for (k, radius) in radii.iter().enumerate() {
        let contrast = if k % 2 == 0 { spot.contrast } else { -spot.contrast };
        canvas.add(&Spot { a: radius * spot.a, b: radius * spot.b, contrast, ..spot }, 0.8);
    }
}

#[test]
fn a_dot_in_a_closed_ring_is_the_target() {
    let (mut all, mut count) = (0, 0);
    for seed in 0..extent::cases(12, 60) as u64 {
        let mut random = Uniform(seed + 40);
        random.next();
        let sign = if seed % 2 == 0 { 1.0 } else { -1.0 };
        let mut canvas = Canvas::new(300, 300, 128.0 - 80.0 * sign);
        let a = random.within(6.0, 25.0);
        let spot = Spot {
            u: 150.0 + random.next(),
            v: 150.0 + random.next(),
            a,
            b: a * random.within(0.6, 1.0),
            angle: random.within(0.0, 3.1),
            contrast: sign * random.within(60.0, 150.0),
        };
        // the gap up to two radii, the ring up to three, as codes have them, and others
        let gap = random.within(1.7, 2.4);
        nested(&mut canvas, spot, &[gap + random.within(0.6, 1.3), gap, 1.0]);
        for codes in [Codes::None, Codes::Auto] {
            let detection = found(&canvas.expose(2.0, seed), &DetectOptions { codes, ..DetectOptions::default() });
            all += 1;
            let Some(target) = at(&detection.targets, &spot) else { continue };
            count += 1;
            assert!((target.major / (2.0 * spot.a) - 1.0).abs() < 0.05 && target.inner.is_none(), "{seed}: {target:?}");
        }
    }
    assert!(100 * count >= 95 * all, "{count} of {all}");
}

#[test]
fn of_one_polarity_alone_the_disc_of_it_is_the_target() {
    let mut canvas = Canvas::new(200, 200, 200.0);
    let disc = Spot { u: 100.3, v: 99.6, a: 50.0, b: 45.0, angle: 0.4, contrast: -150.0 };
    nested(&mut canvas, disc, &[1.0, 0.4]);
    let picture = canvas.expose(2.0, 1);
    let bright = DetectOptions { polarity: PolarityChoice::Bright, ..DetectOptions::default() };
    let [target] = &found(&picture, &bright).targets[..] else { panic!("one target") };
    assert!((target.major - 40.0).abs() < 1.0 && target.inner.is_none(), "{target:?}");
    let [target] = &found(&picture, &DetectOptions::default()).targets[..] else { panic!("one target") };
    let hole = target.inner.expect("a hole");
    assert!((target.major - 100.0).abs() < 1.0 && (hole.major - 40.0).abs() < 1.0, "{target:?}");
    let json = serde_json::to_value(target).expect("JSON");
    assert_eq!(json["inner"]["off_centre"], false);
    assert_eq!(serde_json::from_value::<Target>(json).expect("a target"), *target);
    // a click in the hole, in the disc and beside it
    let view = picture.view().expect("a picture");
    for (u, v) in [(100.0, 100.0), (100.0, 130.0), (70.0, 99.0)] {
        let clicked = measure_at(&view, u, v, &DetectOptions::default()).expect("a place").expect("a target");
        assert!((clicked.major - 100.0).abs() < 1.0 && clicked.inner.is_some(), "{u} {v}: {clicked:?}");
        let all = measure_all(&view, u, v, &DetectOptions::default()).expect("a place");
        assert_eq!(all.len(), 4);
        for result in &all {
            let target = result.target.as_ref().expect("every method measures it");
            let off = (target.u - disc.u).hypot(target.v - disc.v);
            assert!(
                target.inner.is_some() && off < if result.method == Method::Gradient { 0.3 } else { 0.1 },
                "{off} {result:?}"
            );
        }
    }
}

/// Sectors of a ring that is not read are no targets, whether codes are asked for or not; one disc beside a dot is.
#[test]
fn sectors_of_an_unread_ring_are_no_targets() {
    for seed in 0..extent::cases(20, 100) as u64 {
        let mut random = Uniform(seed + 90);
        random.next();
        let sign = if seed % 2 == 0 { 1.0 } else { -1.0 };
        let mut canvas = Canvas::new(260, 260, 128.0 - 80.0 * sign);
        let a = random.within(9.0, 20.0);
        let contrast = sign * random.within(80.0, 150.0);
        let dot = Spot { u: 130.0 + random.next(), v: 130.0 + random.next(), a, b: a, angle: 0.0, contrast };
        canvas.add(&dot, 0.8);
        // discs as wide as the ring of a design, in its middle, in some of fourteen places
        let [middle, width] = if random.next() < 0.5 { [2.5, 1.0] } else { [2.91, 1.26] };
        let count = 1 + seed as usize % 5;
        let turn = random.within(0.0, std::f64::consts::TAU);
        for k in 0..count {
            let (s, c) = (turn + std::f64::consts::TAU * (2 * k) as f64 / 12.0).sin_cos();
            let radius = 0.5 * width * a * random.within(0.9, 1.05);
            let [u, v] = [dot.u + middle * a * c, dot.v + middle * a * s];
            canvas.add(&Spot { u, v, a: radius, b: 0.97 * radius, angle: 0.0, contrast: 0.9 * contrast }, 0.8);
        }
        for codes in [Codes::None, Codes::Auto] {
            let detection = found(&canvas.expose(1.5, seed), &DetectOptions { codes, ..DetectOptions::default() });
            let target = at(&detection.targets, &dot).expect("the dot is found");
            if count == 1 {
                assert_eq!((detection.targets.len(), target.quality.code_note), (2, None), "{seed}");
            } else {
                assert_eq!(detection.targets.len(), 1, "{seed}: {count} sectors, {:?}", detection.targets);
                assert_eq!(target.quality.code_note, Some(CodeNote::Unread));
                assert_eq!(detection.rejected[&sightline::detection::Reason::CodeRing], count);
            }
        }
    }
}
