//! Dots of a printed grid against the grid: a homography with radial distortion about the middle of the picture.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};
use serde::Deserialize;
use sightline::detection::Detection;

/// Result for a grid.
#[derive(Debug)]
pub struct Score {
    /// Dots within 2.5 px of a target.
    pub hits: usize,
    /// Targets that are not dots.
    pub others: usize,
    /// Rms distance of the hits from the fitted grid, in pixels.
    pub rms: f64,
    /// Rms of the misfit in units of the targets' own sigmas.
    pub chi: f64,
}

#[derive(Deserialize)]
struct Entry {
    grid: [usize; 2],
    centres: Vec<[f64; 2]>,
}

/// The grids of grids.json: picture, columns and rows, dots (pixel centre of the first at 0.5, 0.5).
pub fn grids(json: &str) -> Vec<(String, [usize; 2], Vec<[f64; 2]>)> {
    let all: BTreeMap<String, Entry> = serde_json::from_str(json).expect("grids.json");
    all.into_iter().map(|(name, entry)| (name, entry.grid, entry.centres)).collect()
}

/// Scores a detection against the dots of a grid.
pub fn score(
    detection: &Detection,
    size: [usize; 2],
    name: &str,
    [columns, _]: [usize; 2],
    dots: &[[f64; 2]],
) -> Score {
    let near = |[u, v]: [f64; 2]| {
        let distance = |k: &usize| (detection.targets[*k].u - u).hypot(detection.targets[*k].v - v);
        let nearest = (0..detection.targets.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        (distance(&nearest) < 2.5).then_some(nearest)
    };
    let mut pairs = Vec::new();
    for (i, dot) in dots.iter().enumerate() {
        if let Some(k) = near(*dot) {
            let (column, row) = ((i % columns) as f64, (i / columns) as f64);
            let at = if name.starts_with('a') { [2.0 * column + row % 2.0, row] } else { [column, row] };
            pairs.push((at, k));
        }
    }
    let places: Vec<_> =
        pairs.iter().map(|(at, k)| (*at, [detection.targets[*k].u, detection.targets[*k].v])).collect();
    let residuals = misfits(&places, size);
    let square: f64 = residuals.iter().map(|[x, y]| x * x + y * y).sum();
    let relative: f64 = residuals
        .iter()
        .zip(&pairs)
        .map(|([x, y], (_, k))| {
            (x / detection.targets[*k].sigma_u).powi(2) + (y / detection.targets[*k].sigma_v).powi(2)
        })
        .sum();
    let count = residuals.len().max(1) as f64;
    Score {
        hits: pairs.len(),
        others: detection.targets.len() - pairs.len(),
        rms: (square / count).sqrt(),
        chi: (relative / (2.0 * count - 9.0).max(1.0)).sqrt(),
    }
}

/// Residuals of places from the homography of their grid with one term of radial distortion, by Gauss-Newton with differences.
pub fn misfits(places: &[([f64; 2], [f64; 2])], [width, height]: [usize; 2]) -> Vec<[f64; 2]> {
    if places.len() < 8 {
        return Vec::new();
    }
    let middle = [width as f64 / 2.0, height as f64 / 2.0];
    let unit = middle[0].hypot(middle[1]);
    let project = |h: &DVector<f64>, [x, y]: [f64; 2]| {
        let w = h[6] * x + h[7] * y + 1.0;
        let [u, v] = [(h[0] * x + h[1] * y + h[2]) / w, (h[3] * x + h[4] * y + h[5]) / w];
        let stretch = 1.0 + h[8] * (u * u + v * v);
        [middle[0] + unit * u * stretch, middle[1] + unit * v * stretch]
    };
    // the linear start
    let mut design = DMatrix::zeros(2 * places.len(), 8);
    let mut right = DVector::zeros(2 * places.len());
    for (i, ([x, y], [u, v])) in places.iter().enumerate() {
        let [u, v] = [(u - middle[0]) / unit, (v - middle[1]) / unit];
        design.row_mut(2 * i).copy_from_slice(&[*x, *y, 1.0, 0.0, 0.0, 0.0, -u * x, -u * y]);
        design.row_mut(2 * i + 1).copy_from_slice(&[0.0, 0.0, 0.0, *x, *y, 1.0, -v * x, -v * y]);
        (right[2 * i], right[2 * i + 1]) = (u, v);
    }
    let start = design.svd(true, true).solve(&right, 1e-14).expect("a grid");
    let mut h = start.insert_row(8, 0.0);
    let residuals = |h: &DVector<f64>| {
        DVector::from_iterator(
            2 * places.len(),
            places.iter().flat_map(|(at, [u, v])| {
                let [x, y] = project(h, *at);
                [u - x, v - y]
            }),
        )
    };
    for _ in 0..12 {
        let now = residuals(&h);
        let columns: Vec<_> = (0..9)
            .map(|k| {
                let step = 1e-6 * h[k].abs().max(1e-3);
                let mut moved = h.clone();
                moved[k] += step;
                (&now - residuals(&moved)) / step
            })
            .collect();
        let step = DMatrix::from_columns(&columns).svd(true, true).solve(&now, 1e-14).expect("a grid");
        h += step;
    }
    residuals(&h).as_slice().chunks(2).map(|pair| [pair[0], pair[1]]).collect()
}
