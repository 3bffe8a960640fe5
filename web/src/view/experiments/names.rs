//! Words for the engine's identifiers; those without words are symbols shown as they are.

use sightline_lab::experiments::{Assumption, Chart, Figure};

use crate::format;
use crate::i18n::experiments as words;
use crate::i18n::text;

/// A name in a cell, on an axis or after a figure.
pub fn name(id: &str) -> String {
    let word = match id {
        "all" => words::all(),
        "reduced" => words::reduced(),
        "control" => words::control(),
        "free" => words::free(),
        "observed" => words::observed(),
        "unknown" => words::unknown(),
        "yes" => words::yes(),
        "no" => words::no(),
        "greatest" => words::greatest(),
        "least" => words::least(),
        "mean" => words::mean(),
        "standard_deviation" => words::standard_deviation(),
        "rms" => words::rms(),
        "similarity" => words::similarity(),
        "affine" => words::affine(),
        "projective" => words::projective(),
        "similarity-corrected" => words::similarity_corrected(),
        "affine-corrected" => words::affine_corrected(),
        "projective-corrected" => words::projective_corrected(),
        "least_squares" => text::method_least_squares(),
        "ellipse" => text::method_ellipse(),
        "intensity" => text::method_intensity(),
        "gradient" => text::method_gradient(),
        "field" => words::field(),
        "planes" => words::planes(),
        "sites" => words::step_sites(),
        "demosaiced" => words::step_demosaiced(),
        "sharpened" => words::step_sharpened(),
        "toned" => words::step_toned(),
        "jpeg-92" => words::step_jpeg_92(),
        "jpeg-75" => words::step_jpeg_75(),
        _ => return network(id),
    };
    word.to_owned()
}

/// `I-free` and the like; other names are the paper's own.
fn network(id: &str) -> String {
    match id.rsplit_once('-') {
        Some((network, datum @ ("control" | "free"))) => format!("{network}, {}", name(datum)),
        _ => symbol(id).unwrap_or(id).to_owned(),
    }
}

/// Symbols of parameters and elements.
fn symbol(id: &str) -> Option<&'static str> {
    Some(match id {
        "qx" => "Qx",
        "qy" => "Qy",
        "qz" => "Qz",
        "sx" => "σX",
        "sy" => "σY",
        "sz" => "σZ",
        "s_x" => "Sx",
        "s_y" => "Sy",
        "s_z" => "Sz",
        "m0" => "M₀",
        "ms" => "Mₛ",
        "s0" => "S₀",
        "s0_sigma" => "σ S₀",
        "sigma0" => "σ₀",
        "omega" => "ω",
        "phi" => "φ",
        "kappa" => "κ",
        "xl" => "XL",
        "yl" => "YL",
        "zl" => "ZL",
        "x0" => "x₀",
        "y0" => "y₀",
        "k0" => "K₀",
        "k1" => "K₁",
        "k2" => "K₂",
        "k3" => "K₃",
        "p1" => "P₁",
        "p2" => "P₂",
        "sigma" => "σ",
        "dx" => "ΔX",
        "dy" => "ΔY",
        "dz" => "ΔZ",
        "m" => "m",
        "n" => "n",
        _ => return None,
    })
}

/// A column, an axis or a line.
pub fn label(id: &str) -> String {
    if let Some((family, kind)) = id.split_once('/') {
        return format!("{}, {}", label(family), name(kind));
    }
    if let Some(symbol) = symbol(id) {
        return symbol.to_owned();
    }
    if let Some(base) = id.strip_suffix("_reduced") {
        return words::reduced_of(label(base));
    }
    if let Some(axis @ ("x" | "y" | "z")) = id.strip_prefix("pair_") {
        return words::pair_of(axis.to_uppercase());
    }
    if let Some(axis @ ("x" | "y" | "z")) = id.strip_prefix("bundle_") {
        return words::bundle_of(axis.to_uppercase());
    }
    if let Some(axis @ ("x" | "y" | "z" | "u" | "v")) = id.strip_prefix("rms_") {
        return format!("{} {axis}", words::rms());
    }
    if let Some(axis @ ("u" | "v")) = id.strip_prefix("mean_") {
        return format!("{} {axis}", words::mean());
    }
    let word = match id {
        "network" => words::network(),
        "photo" => words::photo(),
        "photos" => words::photos(),
        "point" => words::point(),
        "rays" => words::rays(),
        "run" => words::photos_of_run(),
        "points" => words::points(),
        "count" => words::count(),
        "found" => words::found(),
        "type" => words::overlap_type(),
        "standard_error" => words::standard_error(),
        "rms_error" => words::rms_error(),
        "improvement" => words::improvement(),
        "distance" => words::distance(),
        "equations" => words::equations(),
        "unknowns" => words::unknowns(),
        "datum" => words::datum(),
        "parameters" => words::parameters(),
        "relative" => words::relative_column(),
        "method" => words::method(),
        "largest" => words::largest(),
        "mark" => words::mark(),
        "kind" => words::kind(),
        "parameter" => words::parameter(),
        "value" => words::value(),
        "radius" => words::radius(),
        "distortion" => words::distortion(),
        "table" => words::table(),
        "polynomial" => words::polynomial(),
        "residual" => words::residual(),
        "distortion_corrected" => words::corrected(),
        "marks_sigma0" => words::marks_sigma0(),
        "planted" => words::planted(),
        "error" => words::error(),
        "element" => words::element(),
        "dlt" => words::dlt(),
        "bundle" => words::bundle(),
        "statistic" => words::statistic(),
        "total" => words::total(),
        "iteration" => words::iteration(),
        "all" => words::all(),
        "reduced" => words::reduced(),
        "pair_unaided" => words::pair_unaided(),
        "pair_draws" => words::pair_draws(),
        "bundle_draws" => words::bundle_draws(),
        "pair_rms" => return words::pair_of(words::rms()),
        "bundle_rms" => return words::bundle_of(words::rms()),
        "pair_rms_draws" => words::pair_rms_draws(),
        "bundle_rms_draws" => words::bundle_rms_draws(),
        "pair_unaided_rms" => words::pair_unaided_rms(),
        "pair_unaided_rms_draws" => words::pair_unaided_rms_draws(),
        "step" => words::step_of_camera(),
        "centre_rms" => words::centre_rms(),
        "error_over_sigma" => words::error_over_sigma(),
        "object_rms" => words::object_rms(),
        "object_sigma" => words::object_sigma(),
        "over_sites" => words::over_sites(),
        "vx" => "vₓ",
        "vy" => "vᵧ",
        "rms" => words::rms(),
        other => return other.to_owned(),
    };
    word.to_owned()
}

/// A figure: what it is and of which network.
pub fn figure(figure: &Figure) -> String {
    let (id, of) = figure.id.split_once('/').unwrap_or((&figure.id, ""));
    let axis = |prefix: &str| id.strip_prefix(prefix).map(str::to_uppercase);
    let what = match id {
        "m0_mean" => return words::m0_mean(of),
        "m0_up_to" => return words::m0_up_to(of),
        "observations" => words::observations().to_owned(),
        "unknowns" => words::unknowns().to_owned(),
        "equations" => words::equations().to_owned(),
        "m0_least" => words::m0_least().to_owned(),
        "m0_greatest" => words::m0_greatest().to_owned(),
        "monte_carlo_over_s" => return words::monte_carlo(of),
        "qx" | "qy" | "qz" | "m0" => words::fall_of(label(id)),
        "relative" => words::relative().to_owned(),
        "relative_median" => words::relative_median().to_owned(),
        "centre_rms" => words::centre_rms().to_owned(),
        "object_rms" => words::object_rms().to_owned(),
        "visible" => words::visible().to_owned(),
        "distortion_sigma0" => words::distortion_sigma0().to_owned(),
        "marks_sigma0" => words::marks_sigma0().to_owned(),
        "sigma0" => words::bundle_sigma0().to_owned(),
        "iterations" => words::iterations().to_owned(),
        "check_points" => words::check_points().to_owned(),
        "greatest" | "least" | "mean" | "standard_deviation" | "rms" => {
            return format!("{} {}", name(id), of.to_uppercase());
        }
        _ => {
            if let Some(base) = id.strip_prefix("base_") {
                words::base_fall(base)
            } else if let Some(axis) = id.strip_prefix("residual_px_").or(id.strip_prefix("residual_")) {
                words::residual_axis(axis)
            } else if let Some(axis) = axis("rms_sigma_") {
                words::rms_sigma(axis)
            } else if let Some(parameter) = id.strip_prefix("error_") {
                words::error_of(label(parameter))
            } else if let Some(axis) = axis("gain_") {
                words::gain_of(axis)
            } else {
                label(id)
            }
        }
    };
    match of.parse::<f64>() {
        Ok(_) => format!("{what}, {of} m"),
        Err(_) if of.is_empty() => what,
        Err(_) => format!("{what}, {}", name(of)),
    }
}

/// The title of a table.
pub fn table(id: &str) -> String {
    let word = match id {
        "single" => words::t_single(),
        "mixed" => words::t_mixed(),
        "improvement" => words::t_improvement(),
        "pairwise" => words::t_pairwise(),
        "fiducials" => words::t_fiducials(),
        "transformations" => words::t_transformations(),
        "distortion" => words::t_distortion(),
        "reductions" => words::t_reductions(),
        "photos" => words::t_photos(),
        "parameters" => words::t_parameters(),
        "two_rays" => words::t_two_rays(),
        "estimators" => words::t_estimators(),
        "standard_errors" => words::t_standard_errors(),
        "free_gain" => words::t_free_gain(),
        "check_points" => words::t_check_points(),
        "statistics" => words::t_statistics(),
        "orientation" => words::t_orientation(),
        "interior" => words::t_interior(),
        "sensor_steps" => words::t_sensor_steps(),
        other => other,
    };
    word.to_owned()
}

/// The title of a chart.
pub fn chart(chart: &Chart) -> String {
    match chart.id.split_once('/') {
        Some(("errors", n)) => words::c_errors(n),
        Some(("improvement", distance)) => words::c_improvement(distance),
        Some(("standard_errors", axis)) => words::c_standard_errors(axis.to_uppercase()),
        Some((way, photo)) => words::c_way(label(way.trim_start_matches("way_")), photo),
        None => match chart.id.as_str() {
            "mixed" => words::c_mixed().to_owned(),
            "pairwise" => words::c_pairwise().to_owned(),
            "distortion" => words::c_distortion().to_owned(),
            "distortion_error" => words::c_distortion_error().to_owned(),
            "sensor_centres" => words::c_sensor_centres().to_owned(),
            "sensor_objects" => words::c_sensor_objects().to_owned(),
            other => other.to_owned(),
        },
    }
}

/// An assumption as a sentence.
pub fn assumption(a: &Assumption) -> String {
    let value = |v: Option<f64>| v.map(format::editable).unwrap_or_default();
    let (ours, paper) = (value(a.ours), value(a.paper));
    match a.id.as_str() {
        "base_line_centre" => words::a_base_line_centre().to_owned(),
        "overall_means" => words::a_overall_means().to_owned(),
        "pairwise_draws" => words::a_pairwise().to_owned(),
        "sigma0_draws" => words::a_sigma0_draws(ours),
        "film_draws" => words::a_film_draws(ours),
        "gain_misprint" => words::a_gain_misprint(format::fixed(a.ours.unwrap_or_default(), 1), paper),
        "readings_made_up" => words::a_readings().to_owned(),
        "distortion_made_up" => words::a_distortion().to_owned(),
        "film_scale_along" => words::a_film_along(ours),
        "film_scale_across" => words::a_film_across(ours),
        "station_distance" => words::a_station_distance(ours, paper),
        "field_depth" => words::a_field_depth(ours),
        "station_directions" => words::a_station_directions().to_owned(),
        "psf" => words::a_psf(ours),
        "pixel_noise" => words::a_pixel_noise(ours),
        "centroid_adjusted" => words::a_centroid().to_owned(),
        "base_distance" => words::a_base_distance(ours, paper),
        "ray_on_wall" => words::a_ray_on_wall(ours),
        "outer_stations" => words::a_outer(ours),
        "relief" => words::a_relief(ours),
        "parameters_observed" => words::a_observed().to_owned(),
        "principal_distance" => words::a_principal_distance(ours),
        "survey_error" => words::a_survey(ours),
        "target_diameter" => words::a_diameter(ours),
        "sharpening" => words::a_sharpening(ours),
        "control_places" => words::a_control_places().to_owned(),
        other => format!("{other} {ours} {}", a.unit),
    }
}
