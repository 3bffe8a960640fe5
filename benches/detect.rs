//! Target detection natively: accuracy of isolated circles against the Cramér-Rao bound, and time per megapixel.
//!
//! Circles of contrast 200, noise 2, point spread 0.7 px, painted by the tests' independent renderer. Times are medians on
//! one thread.

use std::time::Instant;

use sightline::detect::detect;
use sightline::detection::{DetectOptions, Method};
use sightline::image::{Grey, GreyView, Samples, SamplesView};

#[path = "../tests/engine/painter.rs"]
mod painter;
use painter::{Canvas, Spot, Uniform};

/// Diameter and bound per axis in pixels.
const BOUNDS: [(f64, f64); 4] = [(5.0, 0.00614), (10.0, 0.00422), (20.0, 0.00296), (40.0, 0.00209)];

fn circles(diameter: f64, columns: usize, seed: u64) -> (Grey, Vec<Spot>) {
    let pitch = diameter as usize + 32;
    let mut canvas = Canvas::new(columns * pitch, columns * pitch, 30.0);
    let mut random = Uniform(seed);
    let mut place = |i: usize| (i as f64 + 0.5) * pitch as f64 + random.within(-0.5, 0.5);
    let spots: Vec<Spot> = (0..columns * columns)
        .map(|k| Spot {
            u: place(k % columns),
            v: place(k / columns),
            a: diameter / 2.0,
            b: diameter / 2.0,
            angle: 0.0,
            contrast: 200.0,
        })
        .collect();
    for spot in &spots {
        canvas.add(spot, 0.7);
    }
    (canvas.expose(2.0, seed), spots)
}

fn main() {
    println!("circles of diameter d: rms of the errors over the bound, rms of error over stated sigma");
    for (diameter, bound) in BOUNDS {
        let (picture, spots) = circles(diameter, 20, 11);
        for method in [Method::LeastSquares, Method::Ellipse, Method::Gradient, Method::Intensity] {
            let options = DetectOptions { method, ..DetectOptions::default() };
            let found = detect(&picture.view().expect("a picture"), &options).expect("valid options").targets;
            let (mut squares, mut normalised, mut hits) = (0.0, 0.0, 0);
            for spot in &spots {
                let near = found.iter().find(|t| (t.u - spot.u).hypot(t.v - spot.v) < 1.5);
                let Some(target) = near else { continue };
                let (du, dv) = (target.u - spot.u, target.v - spot.v);
                squares += du * du + dv * dv;
                normalised += (du / target.sigma_u).powi(2) + (dv / target.sigma_v).powi(2);
                hits += 1;
            }
            let n = 2.0 * f64::from(hits);
            println!(
                "d {diameter:2} {method:?}: {hits} of {} found, {} others, rms/bound {:.3}, error/sigma {:.3}",
                spots.len(),
                found.len() - hits as usize,
                f64::sqrt(squares / n) / bound,
                f64::sqrt(normalised / n)
            );
        }
    }
    println!("time natively, one thread");
    let (tile, _) = circles(20.0, 8, 5);
    let Samples::U8(samples) = &tile.samples else { return };
    for megapixels in [6, 24, 96] {
        let width = 1000 * f64::from(megapixels * 3 / 2).sqrt() as usize;
        let height = megapixels as usize * 1_000_000 / width;
        let row =
            |y: usize| samples[y % tile.height * tile.width..].iter().take(tile.width).copied().cycle().take(width);
        let picture: Vec<u8> = (0..height).flat_map(row).collect();
        let view = GreyView::new(width, height, SamplesView::U8(&picture)).expect("as many samples");
        let mut times: Vec<f64> = (0..5)
            .map(|_| {
                let began = Instant::now();
                detect(&view, &DetectOptions::default()).expect("valid options");
                began.elapsed().as_secs_f64() * 1e3
            })
            .collect();
        times.sort_by(f64::total_cmp);
        println!("{width} x {height}: {:.0} ms, {:.2} ms a megapixel", times[2], times[2] / f64::from(megapixels));
    }
}
