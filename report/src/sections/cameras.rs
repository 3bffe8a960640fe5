//! Cameras: interior orientation with standard errors, what was held, and which parameters go together.

use crate::context::Context;
use crate::html::{Html, Table};
use crate::names::{parameter_name, parameter_unit};
use crate::number::{compact, count, decimals_for, fixed, maybe, power, with_sigma};
use sightline::adjustment::AdjustedCamera;
use sightline::project::{Interior, Parameter};

pub fn write(context: &Context, html: &mut Html) {
    for adjusted in &context.adjustment.cameras {
        one(context, adjusted, html);
    }
    rig(context, html);
}

/// Relative poses of cameras that are fixed to each other.
fn rig(context: &Context, html: &mut Html) {
    let (words, poses) = (context.words, &context.adjustment.rig);
    let Some(rig) = context.project.rig.as_deref().filter(|_| !poses.is_empty()) else { return };
    let unit = &context.project.unit;
    html.h3(words.rig());
    let position = format!("{} {unit}", compact(rig.sigma_position));
    html.note(&words.rig_means(&position, &format!("{} mrad", compact(1000.0 * rig.sigma_rotation))));
    let mut table = Table::new().words(words.camera()).words(words.rig_relative_to());
    for head in ["X", "Y", "Z", words.rig_base(), "σ"] {
        table = table.low(head, "", unit);
    }
    for head in ["ω", "φ", "κ"] {
        table = table.low(head, "", "°");
    }
    table = table.number(words.rig_exposures()).low(words.rig_scatter(), "", unit).low(words.rig_scatter(), "", "mrad");
    for pose in poses {
        let decimals = pose.sigma_base.map_or(3, decimals_for);
        let mut row = vec![pose.camera.clone(), pose.relative_to.clone()];
        row.extend(pose.position.map(|x| fixed(x, decimals)));
        row.extend([fixed(pose.base, decimals), maybe(pose.sigma_base, decimals)]);
        row.extend(pose.rotation.map(|angle| fixed(angle.to_degrees(), 4)));
        row.push(count(pose.exposures.len()));
        row.extend([maybe(pose.scatter_position, decimals), maybe(pose.scatter_rotation.map(|s| 1000.0 * s), 4)]);
        table.row(row);
    }
    html.table(table);
    for off in poses.iter().flat_map(|pose| &pose.exposures).filter(|off| off.outlier) {
        let length = |[x, y, z]: [f64; 3]| x.hypot(y).hypot(z);
        let position = format!("{} {unit}", compact(length(off.position)));
        let rotation = format!("{} mrad", compact(1000.0 * length(off.rotation)));
        let chance = match off.p_value.unwrap_or_default() {
            small if small < 1e-4 => "< 0.0001".to_owned(),
            p => format!("= {}", fixed(p, 4)),
        };
        let [first, own] = &off.photos;
        html.note(&words.rig_outlier(first, own, &position, &rotation, &chance));
    }
}

fn one(context: &Context, adjusted: &AdjustedCamera, html: &mut Html) {
    let (words, camera) = (context.words, &adjusted.camera);
    let model = match camera.interior {
        Interior::Brown { .. } => words.model_brown(),
        Interior::Opencv { .. } => words.model_opencv(),
        Interior::OpencvRational { .. } => words.model_opencv_rational(),
        Interior::OpencvFisheye { .. } => words.model_opencv_fisheye(),
    };
    let photo = adjusted.photo.as_ref().map(|photo| format!(" · {} {photo}", words.photo())).unwrap_or_default();
    html.h3(&format!("{} {}{photo}, {model}", words.camera(), camera.id));
    let photos = context.project.photos.iter().filter(|p| p.camera == camera.id && p.enabled).count();
    let pitch = camera.pixel_pitch.map(|pitch| match pitch.map(|side| compact(1000.0 * side)) {
        [x, y] if x == y => format!("{x} µm"),
        [x, y] => format!("{x} × {y} µm"),
    });
    let size = format!("{} × {} px", camera.width, camera.height);
    html.note(&match pitch {
        Some(pitch) => words.camera_line(&size, &pitch, &count(photos)),
        None => words.camera_line_without_pitch(&size, &count(photos)),
    });
    let mut table = Table::new()
        .words("")
        .words(words.parameter())
        .number(words.value())
        .number("σ (1σ)")
        .words(words.unit())
        .number(words.ratio());
    let estimated = |p: &Parameter| adjusted.sigma.contains_key(p);
    let focal = estimated(&Parameter::F);
    let shown = |p: &Parameter| match p {
        Parameter::F => focal,
        Parameter::Fx => !focal,
        _ => true,
    };
    for parameter in camera.interior.parameters().iter().copied().filter(shown) {
        let value = camera.interior.get(parameter).unwrap_or(0.0);
        let sigma = adjusted.sigma.get(&parameter).copied();
        if sigma.is_none() && value == 0.0 {
            continue;
        }
        let (value, sigma_shown, exponent) = with_sigma(value, sigma);
        let unit = parameter_unit(camera, parameter);
        let unit = if exponent == 0 { unit } else { format!("{} {unit}", power(exponent)) };
        let sigma = if sigma.is_some() { sigma_shown } else { words.held().to_owned() };
        let ratio = maybe(adjusted.significance.get(&parameter).copied(), 1);
        table.row(vec![
            parameter_name(parameter).into(),
            long_name(context, parameter).into(),
            value,
            sigma,
            unit,
            ratio,
        ]);
    }
    html.table(table);
    let zero: Vec<&str> = camera
        .interior
        .parameters()
        .iter()
        .copied()
        .filter(|p| *p != Parameter::F && !estimated(p) && camera.interior.get(*p) == Some(0.0))
        .map(parameter_name)
        .collect();
    if !zero.is_empty() {
        html.note(&words.held_at_zero(&zero.join(", ")));
    }
    let limit = context.adjustment.criteria.high_correlation;
    let pairs = correlated(adjusted, limit);
    if !pairs.is_empty() {
        html.note(&words.correlated(&fixed(limit, 2), &pairs.join("; ")));
    }
}

fn correlated(adjusted: &AdjustedCamera, limit: f64) -> Vec<String> {
    let names = &adjusted.correlation.names;
    let shown = |k: usize| names[k].parse().map_or_else(|_| names[k].clone(), |p| parameter_name(p).to_owned());
    let mut pairs = Vec::new();
    for i in 0..names.len() {
        for j in 0..i {
            let r = adjusted.correlation.matrix.get(i).and_then(|row| row.get(j)).copied().unwrap_or(0.0);
            if r.abs() > limit {
                pairs.push(format!("{} – {} {}", shown(j), shown(i), fixed(r, 2)));
            }
        }
    }
    pairs
}

fn long_name(context: &Context, parameter: Parameter) -> &'static str {
    use Parameter as P;
    let words = context.words;
    match parameter {
        P::C | P::F | P::Fx | P::Fy => words.principal_distance(),
        P::X0 | P::Y0 | P::Cx | P::Cy => words.principal_point(),
        P::K1 | P::K2 | P::K3 => words.radial_distortion(),
        P::P1 | P::P2 => words.decentring_distortion(),
        P::B1 => words.affinity(),
        P::B2 => words.shear(),
        P::K4 | P::K5 | P::K6 => words.radial_distortion(),
    }
}
