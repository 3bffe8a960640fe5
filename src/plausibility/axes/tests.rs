//! Random scenes, mirrored and not.

use super::*;
use crate::noise::Noise;
use crate::rotation::object_to_camera;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

/// Length of the scenes.
const SIZE: f64 = 10.0;
const SIGMA: f64 = 0.002;

struct Scene {
    pairs: Vec<PointPair>,
    poses: Vec<Pose>,
}

/// Points of a wall or floor whose relief is `relief` standard errors (rms), with photos before it held upright; the network of the photos
/// is turned, scaled and noisy. `wrong` points are moved by decimetres.
fn scene(seed: u64, relief: f64, upright: bool, wrong: usize) -> Scene {
    let mut noise = Noise::new(seed, 0);
    // A single wrong point of four or five cannot be distinguished from a reflection of one that is right.
    let count = 4 + (seed % 9) as usize + 4 * wrong;
    let mut random = || (0..3).map(|_| noise.normal()).collect::<Vec<f64>>();
    let mut depth: Vec<f64> = Vec::new();
    let mut flat: Vec<[f64; 2]> = Vec::new();
    // Of corners that are nearly rectangular, so that the form itself is nearly its own mirror image.
    for k in 0..count {
        let r = random();
        let corner = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]][k % 4];
        flat.push([0, 1].map(|a| SIZE * (corner[a] + 0.15 * r[a])));
        depth.push(r[2]);
    }
    // The relief is what a plane leaves.
    let to_plane = |depth: &[f64]| -> Vec<f64> {
        let mut normal = Matrix3::zeros();
        let mut right = Vector3::zeros();
        for (p, d) in flat.iter().zip(depth) {
            let row = Vector3::new(1.0, p[0], p[1]);
            normal += row * row.transpose();
            right += row * *d;
        }
        let plane = normal.try_inverse().expect("corners") * right;
        flat.iter().zip(depth).map(|(p, d)| d - plane.dot(&Vector3::new(1.0, p[0], p[1]))).collect()
    };
    let left = to_plane(&depth);
    let rms = (left.iter().map(|d| d * d).sum::<f64>() / count as f64).sqrt();
    let axes: [Vector3<f64>; 3] = match upright {
        true => [Vector3::x(), Vector3::z(), -Vector3::y()],
        false => [Vector3::x(), Vector3::y(), Vector3::z()],
    };
    let turn = object_to_camera([random()[0], random()[1], random()[2]]);
    let origin = Vector3::new(200_000.0, 450_000.0, 40.0);
    let mut pairs: Vec<PointPair> = Vec::new();
    for (p, d) in flat.iter().zip(&left) {
        let local = axes[0] * p[0] + axes[1] * p[1] + axes[2] * (d / rms * relief * SIGMA);
        let free = turn * (local + 0.3 * SIGMA * Vector3::from_vec(random())) / 7.0;
        let given = origin + local + SIGMA * Vector3::from_vec(random());
        pairs.push(PointPair { free, given, free_sigma: 0.3 * SIGMA / 7.0, given_sigma: SIGMA });
    }
    for k in 0..wrong {
        let r = random();
        pairs[3 * k].given += 0.3 * Vector3::from_vec(r).normalize();
    }
    let centre = axes[0] * 0.5 * SIZE + axes[1] * 0.5 * SIZE;
    let mut poses = Vec::new();
    for k in 0..4 {
        let centre = centre + axes[2] * 2.0 * SIZE + axes[0] * (f64::from(k) - 1.5) * 0.3 * SIZE;
        let m = Matrix3::from_rows(&axes.map(|a| a.transpose()));
        poses.push(Pose { object_to_camera: m * turn.transpose(), centre: turn * centre / 7.0 });
    }
    Scene { pairs, poses }
}

fn mirrored(mut scene: Scene, exchange: Exchange) -> Scene {
    scene.pairs.iter_mut().for_each(|p| p.given = exchange.of(p.given.into()).into());
    scene
}

#[test]
fn two_hundred_mirrored_scenes_are_found_and_two_hundred_right_ones_are_not() {
    for seed in 0..200 {
        let relief = 5.0 * 1.2_f64.powi((seed % 30) as i32);
        let (wall, wrong) = (seed % 2 == 0, (seed % 5 == 4) as usize);
        let right = scene(seed, relief, wall, wrong);
        assert_eq!(question(&right.pairs, &right.poses), None, "seed {seed}");
        let exchange = Exchange::ALL[(seed % 6) as usize];
        let found = mirrored(right, exchange);
        match question(&found.pairs, &found.poses) {
            Some(Question::Mirrored(found)) => {
                assert!(found.rms_exchanged < 0.5 * found.rms_given, "seed {seed}: {found:?}");
                let named = found.exchange == exchange || found.alternatives.contains(&exchange);
                // Where an exchange takes the heights to another axis, a rotation of it is as good.
                assert!(
                    named || matches!(exchange, Exchange::Xz | Exchange::Yz),
                    "seed {seed} {exchange:?}: {found:?}"
                );
            }
            other => panic!("seed {seed}: {other:?}"),
        }
    }
}

#[test]
fn a_plane_is_asked_unless_the_cameras_are_above_it() {
    for seed in 0..100 {
        let (floor, wall) = (scene(seed, 0.0, false, 0), scene(seed, 0.0, true, 0));
        assert_eq!(question(&floor.pairs, &floor.poses), None, "seed {seed}");
        let Some(Question::Undecided(found)) = question(&wall.pairs, &wall.poses) else { panic!("seed {seed}") };
        assert!(Vector3::from(found.normal).dot(&-Vector3::y()) > 0.99, "{found:?}");
        // Seen from below, a floor is a ceiling or a mistake.
        let below = mirrored(floor, Exchange::Xy);
        assert!(matches!(question(&below.pairs, &below.poses), Some(Question::Undecided(_))), "seed {seed}");
        let three = scene(seed, 50.0, true, 0);
        assert!(matches!(question(&three.pairs[..3], &three.poses), Some(Question::Undecided(_))), "seed {seed}");
    }
}

#[test]
fn wrong_names_throughout_are_no_reflection() {
    for seed in 0..200 {
        let mut all = scene(seed, 500.0, true, 0);
        let count = all.pairs.len();
        let given: Vec<_> = (0..count).map(|k| all.pairs[(k * 5 + 1 + seed as usize % 3) % count].given).collect();
        if count.is_multiple_of(5) {
            continue;
        }
        all.pairs.iter_mut().zip(given).for_each(|(pair, given)| pair.given = given);
        assert!(!matches!(question(&all.pairs, &all.poses), Some(Question::Mirrored(_))), "seed {seed}");
    }
}
