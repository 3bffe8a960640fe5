//! Photos split into parts with similar geometry: balanced by position in space and by roll.
//!
//! A photo is described by its projection centre, in units of the photos' spread, and by the direction of its image rows in space, which its roll
//! turns. The photo farthest from the middle of those left is taken together with its nearest neighbours, one for each part; of the ways to
//! deal them out in turn, the one that keeps the sums of the parts nearest to each other is taken. What is over at the end is dealt in the same way.
//! The split depends on the photos alone, not on their order.

use nalgebra::{SVector, Vector3};

use crate::project::Photo;
use crate::rotation::object_to_camera;

/// Position, direction of the rows.
type Stance = SVector<f64, 6>;

/// The part of each photo, counted from 0. Photos without position or rotation count as standing in the middle.
pub fn balanced(photos: &[&Photo], parts: usize) -> Vec<usize> {
    // Everything is computed in the order of the names: in another one sums differ by rounding, which decides between two that are alike.
    let mut order: Vec<usize> = (0..photos.len()).collect();
    order.sort_by(|a, b| photos[*a].id.cmp(&photos[*b].id));
    let named: Vec<&Photo> = order.iter().map(|k| photos[*k]).collect();
    let mut part = vec![0; photos.len()];
    order.into_iter().zip(dealt(&named, parts)).for_each(|(k, to)| part[k] = to);
    part
}

/// The part of each photo, in this order.
fn dealt(photos: &[&Photo], parts: usize) -> Vec<usize> {
    let stances = stances(photos);
    let mut open: Vec<usize> = (0..photos.len()).collect();
    let mut part = vec![0; photos.len()];
    let mut sums = vec![Stance::zeros(); parts];
    let mut counts = vec![0_usize; parts];
    while !open.is_empty() {
        let middle = open.iter().map(|k| stances[*k]).sum::<Stance>() / open.len() as f64;
        let first = farthest(&open, |k| (stances[k] - middle).norm());
        let mut group = vec![open.remove(first)];
        while group.len() < parts && !open.is_empty() {
            let next = farthest(&open, |k| -(stances[k] - stances[group[0]]).norm());
            group.push(open.remove(next));
        }
        let uneven = |turn: usize| {
            let mut sums = sums.clone();
            let mut counts = counts.clone();
            group.iter().enumerate().for_each(|(n, k)| {
                sums[(n + turn) % parts] += stances[*k];
                counts[(n + turn) % parts] += 1;
            });
            let mean = sums.iter().sum::<Stance>() / parts as f64;
            let spread = counts.iter().max().unwrap_or(&0) - counts.iter().min().unwrap_or(&0);
            (spread, sums.iter().map(|sum| (sum - mean).norm_squared()).sum::<f64>())
        };
        let order = |a: &usize, b: &usize| {
            let ((a, by_a), (b, by_b)) = (uneven(*a), uneven(*b));
            a.cmp(&b).then(by_a.total_cmp(&by_b))
        };
        let turn = (0..parts).min_by(order).unwrap_or(0);
        for (n, k) in group.iter().enumerate() {
            let to = (n + turn) % parts;
            part[*k] = to;
            sums[to] += stances[*k];
            counts[to] += 1;
        }
    }
    part
}

/// Place of the largest value in a list; the first of several.
fn farthest(open: &[usize], value: impl Fn(usize) -> f64) -> usize {
    let mut best = (0, f64::NEG_INFINITY);
    for (n, k) in open.iter().enumerate() {
        let value = value(*k);
        if value > best.1 {
            best = (n, value);
        }
    }
    best.0
}

fn stances(photos: &[&Photo]) -> Vec<Stance> {
    let placed: Vec<Vector3<f64>> = photos.iter().filter_map(|p| p.position).map(Vector3::from).collect();
    let middle = placed.iter().sum::<Vector3<f64>>() / placed.len().max(1) as f64;
    let spread = placed.iter().map(|p| (p - middle).norm_squared()).sum::<f64>() / placed.len().max(1) as f64;
    let scale = if spread > 0.0 { 1.0 / spread.sqrt() } else { 0.0 };
    let stance = |photo: &&Photo| {
        let position = photo.position.map_or(Vector3::zeros(), |p| (Vector3::from(p) - middle) * scale);
        let rows = photo.rotation.map_or(Vector3::zeros(), |r| object_to_camera(r).row(0).transpose());
        Stance::from_iterator(position.iter().chain(rows.iter()).copied())
    };
    photos.iter().map(stance).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn photo(id: String, position: [f64; 3], kappa: f64) -> Photo {
        Photo { id, position: Some(position), rotation: Some([0.1, -0.2, kappa]), ..Photo::default() }
    }

    #[test]
    fn pairs_of_alike_photos_are_parted_and_the_order_does_not_matter() {
        // two rings, near and far, each photo with a twin that hardly differs from it
        let all: Vec<Photo> = (0..24)
            .map(|k| {
                let (ring, turn) = (1.0 + f64::from(k % 2), f64::from(k / 4) * 1.05);
                let by = 0.01 * f64::from(k % 4 / 2);
                let position = [ring * turn.cos() + by, ring * turn.sin(), 2.0 * ring];
                photo(format!("{k:02}"), position, f64::from(k / 4 % 4) * 1.57)
            })
            .collect();
        let photos: Vec<&Photo> = all.iter().collect();
        let part = balanced(&photos, 2);
        assert_eq!(part.iter().filter(|p| **p == 0).count(), 12);
        for k in (0..24).filter(|k| k % 4 < 2) {
            assert_ne!(part[k], part[k + 2], "{k}");
        }
        let turned: Vec<&Photo> = all.iter().rev().collect();
        let again: Vec<usize> = balanced(&turned, 2).into_iter().rev().collect();
        assert_eq!(part, again);
    }

    #[test]
    fn parts_differ_by_one_photo_at_most_and_lie_about_one_middle() {
        let all: Vec<Photo> = (0..23)
            .map(|k| {
                let share = |step: f64| (f64::from(k) * step).fract() - 0.5;
                photo(k.to_string(), [share(0.618), share(0.755), share(0.57)], f64::from(k % 4) * 1.57)
            })
            .collect();
        let photos: Vec<&Photo> = all.iter().collect();
        for parts in 2..6 {
            let part = balanced(&photos, parts);
            let count = |p: usize| part.iter().filter(|own| **own == p).count();
            let counts: Vec<usize> = (0..parts).map(count).collect();
            assert!(counts.iter().max().unwrap() - counts.iter().min().unwrap() <= 1, "{counts:?}");
            for p in 0..parts {
                let own = all.iter().zip(&part).filter(|(_, part)| **part == p);
                let mean = own.map(|(photo, _)| Vector3::from(photo.position.unwrap())).sum::<Vector3<f64>>();
                // a random share of 23 / parts photos in a cube of side 1 lies 0.5 / √(23 / parts) off the middle
                assert!(mean.norm() / (count(p) as f64) < 0.5 / (23.0 / parts as f64).sqrt(), "{parts} {p}");
            }
        }
    }

    #[test]
    fn photos_without_orientation_are_dealt_too() {
        let bare = Photo { id: "a".into(), ..Photo::default() };
        let of_first = balanced(&[&bare, &bare, &bare], 2).iter().filter(|p| **p == 0).count();
        assert!(of_first == 1 || of_first == 2, "{of_first}");
        assert!(balanced(&[], 2).is_empty());
    }
}
