//! Tables, figures and charts of the calibration, compared with the paper's.

use super::{PITCH_MM, PLANTED, dcs420};
use crate::experiments::outcome::{Cell, Chart, Figure, Series, Table};
use sightline::adjustment::Adjustment;
use sightline::camera::Model;
use sightline::project::{Interior, Parameter};

/// Residuals x, y, total in µm and points of each photo in the paper's table 1, and of all.
const PAPER_PHOTOS: [[f64; 4]; 12] = [
    [0.43, 0.33, 0.39, 119.0],
    [0.59, 0.50, 0.55, 102.0],
    [0.52, 0.53, 0.52, 100.0],
    [0.30, 0.36, 0.33, 113.0],
    [0.40, 0.32, 0.36, 119.0],
    [0.38, 0.33, 0.36, 111.0],
    [0.48, 0.55, 0.52, 101.0],
    [0.45, 0.39, 0.42, 117.0],
    [0.31, 0.31, 0.31, 109.0],
    [0.37, 0.47, 0.42, 107.0],
    [0.74, 0.68, 0.71, 108.0],
    [0.44, 0.29, 0.37, 114.0],
];
const PAPER_ALL: [f64; 3] = [0.46, 0.43, 0.45];

/// Rms residuals of a whole adjustment in x and y, µm.
fn residuals(adjustment: &Adjustment) -> [f64; 2] {
    let used: Vec<_> = adjustment.observations.iter().filter(|o| o.enabled).collect();
    let rms =
        |v: &dyn Fn(usize) -> f64| ((0..used.len()).map(v).sum::<f64>() / used.len().max(1) as f64).sqrt() * 1000.0;
    let square = |v: Option<f64>| v.map_or(0.0, |v| v * v);
    [rms(&|i| square(used[i].vx)), rms(&|i| square(used[i].vy))]
}

pub fn photos_table(all: &Adjustment, fewer: &Adjustment) -> Table {
    let mut table = Table::new(
        "photos",
        &[
            "photo",
            "x|µm|2",
            "*x|µm|2",
            "y|µm|2",
            "*y|µm|2",
            "total|µm|2",
            "*total|µm|2",
            "points",
            "*points",
            "x_reduced|µm|2",
            "y_reduced|µm|2",
        ],
    );
    let total = |x: f64, y: f64| ((x * x + y * y) / 2.0).sqrt();
    for (i, photo) in all.photos.iter().enumerate() {
        let (x, y) = (photo.rms_x * 1000.0, photo.rms_y * 1000.0);
        let paper = photo
            .id
            .parse::<usize>()
            .ok()
            .and_then(|n| PAPER_PHOTOS.get(n.wrapping_sub(1)))
            .unwrap_or(&PAPER_PHOTOS[i % 12]);
        let kept = fewer.photos.iter().find(|p| p.id == photo.id);
        table.rows.push(vec![
            photo.id.as_str().into(),
            x.into(),
            paper[0].into(),
            y.into(),
            paper[1].into(),
            total(x, y).into(),
            paper[2].into(),
            photo.points.into(),
            paper[3].into(),
            kept.map(|p| p.rms_x * 1000.0).into(),
            kept.map(|p| p.rms_y * 1000.0).into(),
        ]);
    }
    let ([x, y], [x_fewer, y_fewer]) = (residuals(all), residuals(fewer));
    table.rows.push(vec![
        "all".into(),
        x.into(),
        PAPER_ALL[0].into(),
        y.into(),
        PAPER_ALL[1].into(),
        total(x, y).into(),
        PAPER_ALL[2].into(),
        all.photos.iter().map(|p| p.points).sum::<usize>().into(),
        PAPER_PHOTOS.iter().map(|p| p[3]).sum::<f64>().into(),
        x_fewer.into(),
        y_fewer.into(),
    ]);
    table
}

/// Value, standard error and error in standard errors of a parameter.
fn recovered(adjustment: &Adjustment, parameter: Parameter, truth: f64) -> [f64; 3] {
    let Some(camera) = adjustment.cameras.first() else { return [f64::NAN; 3] };
    let value = camera.camera.interior.get(parameter).unwrap_or(f64::NAN);
    let sigma = camera.sigma.get(&parameter).copied().unwrap_or(f64::NAN);
    [value, sigma, (value - truth) / sigma]
}

pub fn parameters_table(all: &Adjustment, fewer: &Adjustment) -> Table {
    let mut table = Table::new(
        "parameters",
        &[
            "parameter",
            "*planted||10",
            "value||10",
            "sigma||10",
            "error|σ|2",
            "value_reduced||10",
            "sigma_reduced||10",
            "error_reduced|σ|2",
        ],
    );
    for (parameter, truth) in PLANTED {
        let mut row: Vec<Cell> = vec![parameter.name().into(), truth.into()];
        row.extend(recovered(all, parameter, truth).map(Cell::from));
        row.extend(recovered(fewer, parameter, truth).map(Cell::from));
        table.rows.push(row);
    }
    table
}

/// Points that two photos of either run determine, with their standard errors: the root mean square over all points rests on them.
pub fn two_ray_table(all: &Adjustment, fewer: &Adjustment) -> Table {
    let mut table = Table::new("two_rays", &["point", "run", "rays", "sx|mm|3", "sy|mm|3", "sz|mm|3"]);
    for (run, adjustment) in [("all", all), ("reduced", fewer)] {
        for point in adjustment.points.iter().filter(|point| point.rays == 2) {
            let mut row: Vec<Cell> = vec![point.id.as_str().into(), run.into(), point.rays.into()];
            row.extend([0, 1, 2].map(|k| Cell::from(point.sigma.map(|sigma| sigma[k]))));
            table.rows.push(row);
        }
    }
    table
}

/// N of 1 : N with the median over the points in the place of the root mean square, which a few weak points decide.
fn median_relative(adjustment: &Adjustment) -> Option<f64> {
    let median = |k: usize| {
        let mut all: Vec<_> = adjustment.points.iter().filter_map(|point| Some(point.sigma?[k])).collect();
        all.sort_by(f64::total_cmp);
        all.get(all.len() / 2).copied()
    };
    let mean = (median(0)? + median(1)? + median(2)?) / 3.0;
    Some(adjustment.precision.as_ref()?.largest_dimension / mean)
}

pub fn figures(all: &Adjustment, fewer: &Adjustment) -> Vec<Figure> {
    let pixel_um = PITCH_MM * 1000.0;
    let mut list = Vec::new();
    for (k, axis) in ["x", "y"].into_iter().enumerate() {
        list.push(Figure::new(format!("residual_{axis}/all"), "µm", residuals(all)[k], PAPER_ALL[k]));
        list.push(Figure::new(format!("residual_{axis}/reduced"), "µm", residuals(fewer)[k], [0.33, 0.28][k]));
        list.push(Figure::new(
            format!("residual_px_{axis}/reduced"),
            "px",
            residuals(fewer)[k] / pixel_um,
            [0.037, 0.031][k],
        ));
    }
    for (label, adjustment) in [("all", all), ("reduced", fewer)] {
        let Some(precision) = &adjustment.precision else { continue };
        for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
            let paper = (label == "reduced").then_some([0.028, 0.062, 0.024][k]);
            list.push(Figure::new(format!("rms_sigma_{axis}/{label}"), "mm", precision.rms_sigma[k], paper));
        }
        let paper = (label == "reduced").then_some(46_400.0);
        list.push(Figure::new(format!("relative/{label}"), "1 : N", precision.relative.unwrap_or(f64::NAN), paper));
        let median = median_relative(adjustment).unwrap_or(f64::NAN);
        list.push(Figure::new(format!("relative_median/{label}"), "1 : N", median, None));
        for (parameter, truth) in PLANTED {
            let id = format!("error_{}/{label}", parameter.name());
            list.push(Figure::new(id, "σ", recovered(adjustment, parameter, truth)[2], None));
        }
    }
    list
}

/// The paper's figure 4, radial distortion over the radius, and how far ours is from what was planted.
pub fn distortion_charts(all: &Adjustment, fewer: &Adjustment) -> Vec<Chart> {
    let curve = |interior: &Interior| {
        let mut radial = Interior::brown(1.0);
        for parameter in [Parameter::K1, Parameter::K2, Parameter::K3] {
            radial.set(parameter, interior.get(parameter).unwrap_or(0.0));
        }
        let model = Model::new(&radial);
        let at = |k: i32| {
            let r = f64::from(k) * 0.2;
            match &model {
                Some(Model::Brown(brown)) => Some([r, (brown.corrected([r, 0.0]).0[0] - r) * 1000.0]),
                _ => None,
            }
        };
        (0..=42).filter_map(at).collect::<Vec<_>>()
    };
    let planted = curve(&dcs420().interior);
    let (mut curves, mut errors) = (Vec::new(), Vec::new());
    for (id, adjustment) in [("all", all), ("reduced", fewer)] {
        let Some(camera) = adjustment.cameras.first() else { continue };
        let ours = curve(&camera.camera.interior);
        errors.push(Series::new(id, ours.iter().zip(&planted).map(|(a, b)| [a[0], a[1] - b[1]]).collect()));
        curves.push(Series::new(id, ours));
    }
    curves.push(Series { paper: true, ..Series::new("planted", planted) });
    vec![
        Chart::new("distortion", "radius|mm", "distortion|µm", curves),
        Chart::new("distortion_error", "radius|mm", "error|µm", errors),
    ]
}
