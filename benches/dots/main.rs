//! Matching of bare dots in seeded scenes, natively: `cargo bench --bench dots -- [first seed] [seeds]`.

mod scene;

use std::time::Instant;

fn main() {
    let numbers: Vec<u64> = std::env::args().filter_map(|a| a.parse().ok()).collect();
    let (first, seeds) = (numbers.first().copied().unwrap_or(1), numbers.get(1).copied().unwrap_or(1));
    println!("seed photos  dots  seconds wanted found  share wrong  tolerance");
    for seed in first..first + seeds {
        for (photos, dots, tolerance) in [
            (3, 600, None),
            (4, 600, None),
            (3, 2500, None),
            (4, 2500, None),
            (8, 2500, None),
            (15, 2500, None),
            (30, 2500, None),
            (30, 2500, Some(10.0)),
        ] {
            let scene = scene::scene(seed, photos, dots);
            let began = Instant::now();
            let m = scene::matched(&scene, tolerance);
            let seconds = began.elapsed().as_secs_f64();
            let share = 100.0 * m.found as f64 / m.wanted.max(1) as f64;
            println!(
                "{seed:4} {photos:6} {dots:5} {seconds:8.2} {:6} {:5} {share:5.1}% {:5}  {tolerance:?}",
                m.wanted, m.found, m.wrong
            );
        }
    }
}
