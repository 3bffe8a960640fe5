//! RAW files written here, over pictures of an independent renderer: what is measured on the sensor's samples.

#[path = "support/camera.rs"]
mod camera;
#[allow(dead_code, reason = "shared with the engine's tests, which use all of it")]
#[path = "../../tests/engine/support/coded_patch.rs"]
mod coded_patch;
#[path = "raw/damage.rs"]
mod damage;
#[path = "support/dng.rs"]
mod dng;
#[path = "../../tests/engine/support/extent.rs"]
mod extent;
#[allow(dead_code, reason = "shared with the engine's tests, which use all of it")]
#[path = "../../tests/engine/support/painter.rs"]
mod painter;

use std::collections::BTreeSet;

use coded_patch::{CodedPatch, Curve, Kind, coded_patch};
use dng::Dng;
use nalgebra::{DMatrix, DVector};
use painter::{Canvas, Spot, Uniform};
use sightline::decode;
use sightline::detect::{colours_apart, detect, detect_photo, detect_shot, measure_in_shot};
use sightline::detection::{Channel, CodeNote, Codes, Colour, DetectOptions, Detection, MeasuredOn, Target};
use sightline::error::Error;
use sightline::image::{Grey, Samples};
use sightline::noise::Noise;
use sightline::ring_code::Family;
use sightline::sensor::{self, Shot, Unpacked};
use sightline_codecs::{Wanted, unpack};
use sightline_lab::sample;

const ORDERS: [&str; 4] = ["RGGB", "GRBG", "GBRG", "BGGR"];
/// Light of a site of each colour, as a share of what green gets.
const COLOURS: [(char, f64); 3] = [('R', 0.55), ('G', 1.0), ('B', 0.7)];
const BLUR: f64 = 0.8;
/// Masked columns and rows before the lit part.
const MASKED: [usize; 2] = [14, 10];

/// A sensor: samples without light, at the most, and the noise σ² = read² + gain · light.
#[derive(Clone, Copy)]
struct Camera {
    bits: u32,
    black: f64,
    white: f64,
    gain: f64,
    read: f64,
}

const TWELVE: Camera = Camera { bits: 12, black: 256.0, white: 4095.0, gain: 0.12, read: 1.6 };
const FOURTEEN: Camera = Camera { bits: 14, black: 512.0, white: 16383.0, gain: 0.5, read: 4.0 };

/// 200 circles of ten diameters from 6 to 40 pixels, bright on dark and dark on bright, as shares of the largest light.
fn scene() -> (Canvas, Vec<Spot>) {
    scene_of(1.0)
}

/// The same with a lens that images everything so much larger about the middle of the lit part.
fn scene_of(scale: f64) -> (Canvas, Vec<Spot>) {
    const PITCH: f64 = 72.0;
    let (columns, rows) = (20, 10);
    let mut canvas =
        Canvas::new((PITCH * 20.0) as usize + MASKED[0] + 6, (PITCH * 10.0) as usize + MASKED[1] + 4, 0.12);
    let half = canvas.width / 2;
    for y in 0..canvas.height {
        for x in half..canvas.width {
            canvas.levels[y * canvas.width + x] = 0.62;
        }
    }
    let mut random = Uniform(17);
    let spots: Vec<Spot> = (0..columns * rows)
        .map(|k| {
            let place = |i: usize, masked: usize| PITCH * (i as f64 + 0.5) + masked as f64;
            let (column, row) = (k % columns, k / columns);
            let (u, v) =
                (place(column, MASKED[0]) + random.within(-2.0, 2.0), place(row, MASKED[1]) + random.within(-2.0, 2.0));
            let middle = [(canvas.width + MASKED[0]) as f64 / 2.0, (canvas.height + MASKED[1]) as f64 / 2.0];
            let (u, v) = (middle[0] + scale * (u - middle[0]), middle[1] + scale * (v - middle[1]));
            let a = radius(row);
            let contrast = if column < columns / 2 { 0.55 } else { -0.5 };
            Spot { u, v, a, b: a, angle: 0.0, contrast }
        })
        .collect();
    spots.iter().for_each(|spot| canvas.add(spot, BLUR));
    (canvas, spots)
}

fn radius(row: usize) -> f64 {
    [3.0, 3.5, 4.0, 5.0, 6.0, 8.0, 10.0, 13.0, 16.0, 20.0][row]
}

/// Read-out of the sensor.
fn exposed(canvas: &Canvas, camera: Camera, pattern: &'static str, seed: u64) -> Dng {
    let mut noise = Noise::new(seed, 0);
    let (width, height) = (canvas.width, canvas.height);
    let filters: Vec<f64> =
        pattern.chars().map(|c| COLOURS.iter().find(|(letter, _)| *letter == c).unwrap().1).collect();
    let lit = |x: usize, y: usize| x >= MASKED[0] && y >= MASKED[1];
    let mut samples = Vec::with_capacity(width * height);
    for y in 0..height {
        for x in 0..width {
            let share = if lit(x, y) { canvas.levels[y * width + x] * filters[y % 2 * 2 + x % 2] } else { 0.0 };
            let light = share * (camera.white - camera.black);
            let sample = camera.black + light + (camera.read.powi(2) + camera.gain * light).sqrt() * noise.normal();
            samples.push(sample.round().clamp(0.0, camera.white) as u16);
        }
    }
    Dng {
        width,
        height,
        bits: camera.bits,
        pattern,
        black: camera.black as u32,
        white: camera.white as u32,
        active_area: [MASKED[1] as u32, MASKED[0] as u32, height as u32, width as u32],
        samples,
        lossless_jpeg: false,
        opcodes: Vec::new(),
        orientation: 1,
        preview: Vec::new(),
    }
}

fn shot(file: &[u8]) -> Shot {
    unpack(file, Wanted::samples(Channel::Grey)).and_then(Unpacked::into_shot).expect("a photo")
}

fn detected(file: &[u8], channel: Channel) -> Detection {
    detect_shot(&shot(file), &DetectOptions { channel, ..DetectOptions::default() }).expect("targets")
}

fn nearest<'a>(targets: &'a [Target], spot: &Spot) -> Option<&'a Target> {
    targets.iter().find(|target| (target.u - spot.u).hypot(target.v - spot.v) < 1.0)
}

/// Cramér-Rao bound of a spot's centre per axis, of the sites of one colour with their own noise: ten unknowns as in the fit.
fn bound(spot: &Spot, camera: Camera, pattern: &str, colour: char, ground: f64) -> f64 {
    let size = 2 * ((spot.a + 5.0 * BLUR + 8.0) as usize / 2 * 2);
    let middle = size as f64 / 2.0;
    let filter = COLOURS.iter().find(|(letter, _)| *letter == colour).unwrap().1;
    let scale = filter * (camera.white - camera.black);
    let image = |k: usize, step: f64| {
        let d = |i: usize| if i == k { step } else { 0.0 };
        let mut canvas = Canvas::new(size, size, 0.0);
        let moved = Spot {
            u: middle + spot.u.rem_euclid(2.0) + d(0),
            v: middle + spot.v.rem_euclid(2.0) + d(1),
            a: spot.a + d(2),
            b: spot.b + d(3),
            angle: 0.0,
            contrast: scale * spot.contrast + scale * d(4),
        };
        canvas.add(&moved, BLUR + d(5));
        canvas.levels
    };
    let letters: Vec<char> = pattern.chars().collect();
    let sites: Vec<usize> =
        (0..size * size).filter(|i| letters[(i / size) % 2 * 2 + (i % size) % 2] == colour).collect();
    let level = image(9, 0.0);
    let mut columns: Vec<DVector<f64>> = (0..6)
        .map(|k| {
            let (more, less) = (image(k, 0.02), image(k, -0.02));
            DVector::from_iterator(sites.len(), sites.iter().map(|i| (more[*i] - less[*i]) / 0.04))
        })
        .collect();
    for k in 0..3 {
        let term = |i: usize| [1.0, (i % size) as f64 - middle, (i / size) as f64 - middle][k];
        columns.push(DVector::from_iterator(sites.len(), sites.iter().map(|i| term(*i))));
    }
    let deviation = |i: usize| {
        let light = level[i] + scale * ground;
        (camera.read.powi(2) + camera.gain * light + 1.0 / 12.0).sqrt()
    };
    let design = DMatrix::from_columns(&columns);
    let weighted = DMatrix::from_fn(sites.len(), columns.len(), |i, j| design[(i, j)] / deviation(sites[i]));
    let cofactors = (weighted.transpose() * weighted).try_inverse().expect("regular");
    ((cofactors[(0, 0)] + cofactors[(1, 1)]) / 2.0).sqrt()
}

/// Hits, false ones, rms of errors in units of the bound, and of errors in units of their sigma.
fn judged(found: &Detection, spots: &[Spot], camera: Camera, pattern: &str, colour: char) -> [f64; 4] {
    let mut bounds = std::collections::HashMap::new();
    let (mut hits, mut ratio, mut normalised) = (0.0, 0.0, 0.0);
    for spot in spots {
        let Some(target) = nearest(&found.targets, spot) else {
            let near =
                found.rejected_blobs.iter().filter(|blob| (blob.u - spot.u).hypot(blob.v - spot.v) < spot.a + 3.0);
            let why: Vec<_> = near.map(|blob| (blob.reason, blob.diameter)).collect();
            println!("missing: {spot:?} {why:?}");
            continue;
        };
        let ground = if spot.contrast > 0.0 { 0.12 } else { 0.62 };
        let key = (spot.a.to_bits(), spot.contrast > 0.0);
        let bound = *bounds.entry(key).or_insert_with(|| bound(spot, camera, pattern, colour, ground));
        let errors = [(target.u - spot.u, target.sigma_u), (target.v - spot.v, target.sigma_v)];
        hits += 1.0;
        for (error, sigma) in errors {
            ratio += (error / bound).powi(2) / 2.0;
            normalised += (error / sigma).powi(2) / 2.0;
        }
    }
    [hits, found.targets.len() as f64 - hits, f64::sqrt(ratio / hits), f64::sqrt(normalised / hits)]
}

#[test]
fn centres_reach_the_bound_of_the_green_sites_and_state_it() {
    let (canvas, spots) = scene();
    let (mut ratios, mut normals, mut count) = (0.0, 0.0, 0.0);
    for (k, pattern) in ORDERS.into_iter().enumerate() {
        for (camera, lossless_jpeg) in [(TWELVE, !k.is_multiple_of(2)), (FOURTEEN, k.is_multiple_of(2))] {
            let file = Dng { lossless_jpeg, ..exposed(&canvas, camera, pattern, 100 + k as u64) }.file();
            let found = detected(&file, Channel::Grey);
            let [hits, wrong, ratio, normal] = judged(&found, &spots, camera, pattern, 'G');
            let measured = found.measured.clone().expect("told");
            let (gain, read) = (measured.gain.expect("a gain"), measured.read_noise.expect("masked columns"));
            println!(
                "{pattern} {} bits: {hits} hits, {wrong} false, rms {ratio:.3} of the bound, error/sigma {normal:.3}, gain {:.4} of {}, read {:.2} of {}",
                camera.bits, gain, camera.gain, read, camera.read
            );
            assert_eq!((hits, wrong), (200.0, 0.0));
            assert!(ratio < 1.15, "{ratio}");
            assert!((gain / camera.gain - 1.0).abs() < 0.05 && (read / camera.read - 1.0).abs() < 0.1, "{gain} {read}");
            assert_eq!((measured.on, measured.colour), (MeasuredOn::Sites, Some(Colour::Green)));
            assert_eq!(measured.pattern.as_deref(), Some(pattern));
            (ratios, normals, count) = (ratios + ratio * ratio, normals + normal * normal, count + 1.0);
        }
    }
    let (ratio, normal) = (f64::sqrt(ratios / count), f64::sqrt(normals / count));
    println!("all: rms {ratio:.3} of the bound, error/sigma {normal:.3}");
    assert!(ratio < 1.10, "{ratio}");
    assert!((0.95..1.05).contains(&normal), "{normal}");
}

#[test]
fn the_camera_s_jpeg_of_the_same_shot_is_no_better() {
    let (canvas, spots) = scene();
    let (mut raw, mut jpeg) = (0.0, 0.0);
    for pattern in ORDERS {
        let dng = exposed(&canvas, FOURTEEN, pattern, 300);
        let photo = decode::photo(&camera::jpeg(&dng, &COLOURS, 92), Channel::Grey).expect("a photo");
        let (on_raw, on_jpeg) = (detected(&dng.file(), Channel::Grey), detect_photo(&photo, &DetectOptions::default()));
        let on_jpeg = on_jpeg.expect("targets");
        let hits = |found: &Detection| spots.iter().filter(|spot| nearest(&found.targets, spot).is_some()).count();
        let (mut squares, mut shared) = ([[0.0; 2]; 2], 0.0);
        for spot in &spots {
            let found = [nearest(&on_raw.targets, spot), nearest(&on_jpeg.targets, spot)];
            let [Some(a), Some(b)] = found else { continue };
            shared += 2.0;
            for (sums, target) in squares.iter_mut().zip([a, b]) {
                let [du, dv] = [target.u - spot.u, target.v - spot.v];
                sums[0] += du * du + dv * dv;
                sums[1] += (du / target.sigma_u).powi(2) + (dv / target.sigma_v).powi(2);
            }
        }
        let [[a, normal_a], [b, normal_b]] = squares.map(|sums| sums.map(|sum| f64::sqrt(sum / shared)));
        println!(
            "{pattern}: RAW {} hits, rms {a:.4} px, error/sigma {normal_a:.2}; JPEG {} hits, rms {b:.4} px, error/sigma {normal_b:.2}",
            hits(&on_raw),
            hits(&on_jpeg)
        );
        (raw, jpeg) = (raw + a * a, jpeg + b * b);
        assert!(hits(&on_raw) >= hits(&on_jpeg));
    }
    println!("all: JPEG / RAW {:.3}", f64::sqrt(jpeg / raw));
    assert!(jpeg > raw, "{raw} {jpeg}");
}

#[test]
fn hits_are_as_on_grey_and_other_colours_may_be_chosen() {
    let (canvas, spots) = scene();
    let sample = |level: &f64| (60000.0 * level) as u16;
    let grey = Grey {
        width: canvas.width,
        height: canvas.height,
        samples: Samples::U16(canvas.levels.iter().map(sample).collect()),
    };
    let on_grey = detect(&grey.view().expect("a picture"), &DetectOptions::default()).expect("targets");
    assert_eq!(spots.iter().filter(|spot| nearest(&on_grey.targets, spot).is_some()).count(), 200);
    // what green has twice the sites for is searched in it, so that nothing is missed; errors are those of the quarter of the sites measured on
    for (channel, colour, letter) in [(Channel::Red, Colour::Red, 'R'), (Channel::Blue, Colour::Blue, 'B')] {
        let (mut square, mut count) = (0.0, 0.0);
        for (pattern, seed) in ORDERS.into_iter().zip(7..) {
            let found = detected(&exposed(&canvas, FOURTEEN, pattern, seed).file(), channel);
            let [hits, wrong, ratio, normal] = judged(&found, &spots, FOURTEEN, pattern, letter);
            println!(
                "{colour:?} {pattern}: {hits} hits, {wrong} false, rms {ratio:.3} of the bound, error/sigma {normal:.3}"
            );
            assert!(hits == 200.0 && wrong == 0.0, "{hits} {wrong}");
            assert!(ratio < 1.25, "{ratio}");
            assert_eq!(found.measured.and_then(|measured| measured.colour), Some(colour));
            square += normal * normal * hits;
            count += hits;
        }
        let normal = f64::sqrt(square / count);
        println!("{colour:?}: error/sigma {normal:.3}");
        assert!((0.95..1.05).contains(&normal), "{normal}");
    }
}

#[test]
fn colours_apart_show_the_lens() {
    let scales = [1.0006, 1.0, 0.9995];
    let files: Vec<Dng> =
        scales.iter().zip(5..).map(|(scale, seed)| exposed(&scene_of(*scale).0, FOURTEEN, "RGGB", seed)).collect();
    let mut file = files[1].clone();
    let width = file.width;
    for (i, sample) in file.samples.iter_mut().enumerate() {
        let colour = [0, 1, 1, 2][(i / width) % 2 * 2 + i % width % 2];
        *sample = files[colour].samples[i];
    }
    let shot = shot(&file.file());
    let apart = colours_apart(|_| Ok(shot.clone()), &DetectOptions::default()).expect("colours");
    assert_eq!(apart.colours.iter().map(|apart| apart.colour).collect::<Vec<_>>(), [Colour::Red, Colour::Blue]);
    for (colour, scale) in apart.colours.iter().zip([1.0006, 0.9995]) {
        let lateral = colour.lateral.expect("a lens");
        let truth = (scale - 1.0) * apart.corner;
        println!(
            "{:?}: {:.4} of {truth:.4} px at the corner, sigma {:.4}, sigma0 {:.3}, {} targets",
            colour.colour, lateral.at_corner, lateral.sigma_at_corner, lateral.sigma0, lateral.targets
        );
        assert!(lateral.targets > 150 && (lateral.at_corner - truth).abs() < 4.0 * lateral.sigma_at_corner);
        assert!(lateral.sigma_at_corner < 0.02 && (0.8..1.25).contains(&lateral.sigma0), "{lateral:?}");
    }
}

#[test]
fn a_click_measures_what_the_search_measures() {
    let (canvas, spots) = scene();
    let shot = shot(&exposed(&canvas, TWELVE, "RGGB", 3).file());
    let options = DetectOptions::default();
    let all = detect_shot(&shot, &options).expect("targets");
    for spot in spots.iter().step_by(37) {
        let target = measure_in_shot(&shot, spot.u + 1.0, spot.v - 1.0, &options).expect("a place").expect("a target");
        let other = nearest(&all.targets, spot).expect("found");
        assert!((target.u - other.u).hypot(target.v - other.v) < 0.1 * other.sigma_u, "{target:?} {other:?}");
    }
    assert_eq!(measure_in_shot(&shot, 3.0, 3.0, &options).expect("inside"), None);
    assert!(measure_in_shot(&shot, -3.0, 3.0, &options).is_err());
}

#[test]
fn clipping_and_hot_sites_leave_no_trace() {
    let (mut canvas, spots) = scene();
    // the bright targets are beyond the scale
    canvas.levels.iter_mut().for_each(|level| *level *= 1.9);
    let mut file = exposed(&canvas, FOURTEEN, "BGGR", 11);
    let mut random = Uniform(5);
    for _ in 0..900 {
        let at = (random.next() * file.samples.len() as f64) as usize;
        file.samples[at] = 16000;
    }
    let found = detected(&file.file(), Channel::Grey);
    let dark: Vec<&Spot> = spots.iter().filter(|spot| spot.contrast > 0.0 && spot.a >= 4.0).collect();
    let (mut squares, mut count) = (0.0, 0.0);
    for spot in &dark {
        let Some(target) = nearest(&found.targets, spot) else { continue };
        squares += ((target.u - spot.u) / target.sigma_u).powi(2) + ((target.v - spot.v) / target.sigma_v).powi(2);
        count += 2.0;
    }
    let (share, normal) = (count / 2.0 / dark.len() as f64, f64::sqrt(squares / count));
    println!("clipped: {share:.2} found, error/sigma {normal:.3}, hot {:?}", found.measured.and_then(|m| m.hot_sites));
    assert!(share > 0.95 && normal < 1.2, "{share} {normal}");
}

#[test]
fn the_file_is_told_and_shown() {
    let (canvas, _) = scene();
    let dng = Dng { orientation: 6, opcodes: warp(), ..exposed(&canvas, TWELVE, "GBRG", 1) };
    let file = dng.file();
    let header =
        unpack(&file, Wanted { channel: Channel::Grey, samples: false, max_side: 200 }).expect("a header").header;
    assert_eq!((header.format.as_str(), header.width as usize, header.bits), ("DNG", canvas.width, 12));
    assert_eq!((header.info.make.as_deref(), header.info.orientation), (Some("Maker"), 6));
    assert_eq!(header.info.date.as_deref(), Some("2026-02-03T04:05:06"));
    assert_eq!(header.corrections, ["WarpRectilinear"]);
    let Shot::Sensor(sensor) = shot(&file) else { panic!("a sensor") };
    assert_eq!(sensor.corrections, ["WarpRectilinear"]);
    assert_eq!(sensor.samples, dng.samples);
    assert_eq!(sensor.mosaic.active_area[..2], [MASKED[0] as u32, MASKED[1] as u32]);
    let picture = sensor::picture(&Shot::Sensor(sensor), 300);
    assert!(
        picture.width <= 300
            && picture.width > 200
            && picture.rgba.len() == 4 * (picture.width * picture.height) as usize
    );
    let packed = Dng { lossless_jpeg: true, ..dng.clone() }.file();
    assert!(packed.len() < file.len());
    let Shot::Sensor(sensor) = shot(&packed) else { panic!("a sensor") };
    assert_eq!(sensor.samples, dng.samples);
    // the picture that a camera puts beside its samples is the one that is shown
    let mut preview = Vec::new();
    let encoder = jpeg_encoder::Encoder::new(&mut preview, 90);
    encoder.encode(&[90; 3 * 320 * 160], 320, 160, jpeg_encoder::ColorType::Rgb).expect("a JPEG");
    let file = Dng { preview, ..dng.clone() }.file();
    let shown = unpack(&file, Wanted { channel: Channel::Grey, samples: true, max_side: 200 }).expect("a photo");
    assert_eq!((shown.header.small, shown.small.len()), ([200, 100], 4 * 200 * 100));
    assert!(shown.small.chunks(4).all(|pixel| pixel[..3].iter().all(|level| level.abs_diff(90) < 3)));
    assert_eq!(shown.samples, Samples::U16(dng.samples));
}

/// Lists cut off anywhere, that claim more than there is, or are noise: reported as unreadable, never as "no corrections". Up to four bytes there is
/// no more than a count, which names no correction: the decoder takes such a list as empty.
#[test]
fn an_unreadable_list_of_corrections_is_told() {
    let (canvas, _) = scene();
    let whole = warp();
    let read = |opcodes: Vec<u8>| {
        let file = Dng { opcodes, ..exposed(&canvas, TWELVE, "RGGB", 1) }.file();
        let header =
            unpack(&file, Wanted { channel: Channel::Grey, samples: false, max_side: 0 }).expect("a header").header;
        (header.corrections, header.unread_corrections)
    };
    assert_eq!(read(whole.clone()), (vec!["WarpRectilinear".to_owned()], 0));
    assert_eq!(read(Vec::new()), (Vec::new(), 0));
    assert_eq!(read(0u32.to_be_bytes().to_vec()), (Vec::new(), 0));
    for end in [5, 9, 19, whole.len() - 1] {
        assert_eq!(read(whole[..end].to_vec()), (Vec::new(), 1), "{end}");
    }
    let mut more = whole.clone();
    more[3] = 7;
    assert_eq!(read(more), (Vec::new(), 1));
    let mut noise = Noise::new(5, 0);
    for _ in 0..20 {
        let list = (0..40).map(|_| (noise.normal() * 60.0) as i8 as u8 | 1).collect();
        assert_eq!(read(list).1, 1);
    }
}

/// An opcode list with a warp that does nothing.
fn warp() -> Vec<u8> {
    let mut list = 1u32.to_be_bytes().to_vec();
    let mut body = 1u32.to_be_bytes().to_vec();
    for value in [1.0f64, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.5] {
        body.extend(value.to_be_bytes());
    }
    for word in [1u32, 0x0103_0000, 1, body.len() as u32] {
        list.extend(word.to_be_bytes());
    }
    list.extend(body);
    list
}

#[test]
fn codes_are_read_as_in_grey() {
    for name in sample::files().into_iter().take(extent::cases(1, 3)) {
        let grey = decode::grey(&sample::file(&name).expect("a photo"), Channel::Grey).expect("a picture");
        let Samples::U8(samples) = &grey.samples else { panic!("not of 8 bits") };
        let mut noise = Noise::new(1, 0);
        let mut light = |level: &u8| (512.0 + 50.0 * f64::from(*level) + 4.0 * noise.normal()).round() as u16;
        let dng = Dng {
            width: grey.width,
            height: grey.height,
            bits: 14,
            pattern: "RGGB",
            black: 512,
            white: 16383,
            active_area: [0, 0, grey.height as u32, grey.width as u32],
            samples: samples.iter().map(&mut light).collect(),
            lossless_jpeg: false,
            opcodes: Vec::new(),
            orientation: 1,
            preview: Vec::new(),
        };
        let shot = shot(&dng.file());
        for codes in [Codes::Ring14, Codes::Auto] {
            let options = DetectOptions { codes, ..DetectOptions::default() };
            let read = |detection: Detection| -> BTreeSet<u32> {
                detection.targets.iter().filter_map(|target| target.code).collect()
            };
            let in_grey = read(detect(&grey.view().expect("a view"), &options).expect("targets"));
            let in_raw = detect_shot(&shot, &options).expect("targets");
            let click = |t: &Target| measure_in_shot(&shot, t.u, t.v, &options).expect("a place")?.code;
            let clicked: BTreeSet<u32> = in_raw.targets.iter().filter_map(click).collect();
            let in_raw = read(in_raw);
            assert!(clicked == in_raw || codes == Codes::Auto, "{clicked:?} {in_raw:?}");
            println!("{name} {codes:?}: {} of {}, {} by clicks", in_raw.len(), in_grey.len(), clicked.len());
            // the search's picture is blurred more: one small code may be lost to that
            assert!(in_grey.len() > 8 && in_raw.is_subset(&in_grey) && in_raw.len() + 1 >= in_grey.len(), "{in_raw:?}");
        }
    }
}

/// A picture of patches drawn at random, six in a row, and where the middle of each of their dots is.
fn sheet(family: Family, kinds: &[Kind], seed: u64) -> (Grey, Vec<(CodedPatch, [f64; 2])>) {
    const CELL: usize = 260;
    let mut random = Uniform(seed);
    let (columns, rows) = (6, kinds.len().div_ceil(6));
    let mut samples = vec![40u8; columns * rows * CELL * CELL];
    let mut patches = Vec::new();
    for (k, kind) in kinds.iter().enumerate() {
        // green has every other site: what is hardly read in grey is not read in light
        let patch = loop {
            let patch = coded_patch(*kind, family, Curve::Flat, &mut random);
            if patch.size <= CELL && patch.sector > 4.0 && patch.tilt < 0.75 && patch.contrast > 80.0 {
                break patch;
            }
        };
        let [left, top] = [k % columns * CELL, k / columns * CELL];
        for (y, row) in patch.samples.chunks_exact(patch.size).enumerate() {
            let at = (top + y) * columns * CELL + left;
            samples[at..at + patch.size].copy_from_slice(row);
        }
        let place = [left as f64 + patch.u, top as f64 + patch.v];
        patches.push((patch, place));
    }
    (Grey { width: columns * CELL, height: rows * CELL, samples: Samples::U8(samples) }, patches)
}

#[test]
fn metashape_codes_are_read_as_in_grey() {
    const FAMILIES: [(Family, Codes); 4] = [
        (Family::Metashape12, Codes::Metashape12),
        (Family::Metashape14, Codes::Metashape14),
        (Family::Metashape16, Codes::Metashape16),
        (Family::Metashape20, Codes::Metashape20),
    ];
    let mut totals = [0; 2];
    for (seed, &(family, codes)) in (61..).zip(extent::of(&FAMILIES, 1)) {
        let mut kinds = vec![Kind::Code; 60];
        kinds.extend([Kind::Other, Kind::Full, Kind::Strange, Kind::Dots, Kind::Hidden, Kind::Satellites]);
        let (grey, patches) = sheet(family, &kinds, seed);
        let Samples::U8(samples) = &grey.samples else { panic!("not of 8 bits") };
        let mut noise = Noise::new(seed, 0);
        let mut light = |level: &u8| (512.0 + 50.0 * f64::from(*level) + 4.0 * noise.normal()).round() as u16;
        let dng = Dng {
            width: grey.width,
            height: grey.height,
            bits: 14,
            pattern: "RGGB",
            black: 512,
            white: 16383,
            active_area: [0, 0, grey.height as u32, grey.width as u32],
            samples: samples.iter().map(&mut light).collect(),
            lossless_jpeg: false,
            opcodes: Vec::new(),
            orientation: 1,
            preview: Vec::new(),
        };
        let shot = shot(&dng.file());
        let options = DetectOptions { codes, ..DetectOptions::default() };
        // how many are read, and those that are read as something else
        let judge = |found: &Detection| {
            let (mut read, mut wrong) = (0, Vec::new());
            for (patch, [u, v]) in &patches {
                let near = |t: &&Target| (t.u - u).hypot(t.v - v) < 2.0;
                let Some(code) = found.targets.iter().find(near).and_then(|target| target.code) else { continue };
                if patch.number == Some(code) {
                    read += 1;
                } else {
                    wrong.push((patch.kind, patch.number, code));
                }
            }
            (read, wrong)
        };
        let (in_grey, _) = judge(&detect(&grey.view().expect("a view"), &options).expect("targets"));
        let in_raw = detect_shot(&shot, &options).expect("targets");
        let mut asked = 0;
        let clicked = in_raw.targets.iter().filter(|target| target.code.is_some()).filter(|target| {
            let click = measure_in_shot(&shot, target.u, target.v, &options).expect("a place");
            // a click sees one ring alone: what the others have settled in the search stays a question
            let asks = |click: &Target| {
                matches!(click.quality.code_note, Some(CodeNote::Uncertain | CodeNote::OtherFamily))
                    && click.code_candidates.iter().any(|candidate| Some(candidate.number) == target.code)
            };
            asked += usize::from(click.as_ref().is_some_and(&asks));
            click.is_some_and(|click| click.code == target.code || asks(&click))
        });
        let clicked = clicked.count();
        let all = in_raw.targets.iter().filter(|target| target.code.is_some()).count();
        let (read, wrong) = judge(&in_raw);
        println!(
            "{codes:?}: {read} read in light, {in_grey} in grey, {clicked} of {all} by clicks, {asked} only ask, wrong {wrong:?}"
        );
        assert_eq!(wrong, [], "{codes:?}");
        // nothing beside a dot is a code, and a click reads what the search did
        assert_eq!((read, clicked), (all, all), "{codes:?}");
        assert!(10 * asked <= all, "{codes:?}: {asked} of {all} clicks only ask");
        totals[0] += read;
        totals[1] += in_grey;
    }
    // half of the sites are green
    let [read, in_grey] = totals;
    assert!(in_grey >= extent::cases(40, 180) && 10 * read >= 9 * in_grey, "{read} of {in_grey}");
}
