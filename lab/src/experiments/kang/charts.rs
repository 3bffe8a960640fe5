//! The paper's charts: figures 4-1 to 4-4 (standard errors over overlap and distance), 4-6 to 4-9 (improvement over the
//! number of photos) and 4-10 (mixed distances).

use super::networks::DISTANCES;
use super::{NetworkErrors, fall, find};
use crate::experiments::outcome::Tick;
use crate::experiments::{Chart, Series};

const KINDS: [(char, &str); 3] = [('A', "A"), ('B', "B"), ('C', "C")];
/// A figure of a network.
type Value = fn(&NetworkErrors) -> f64;

const AXES: [&str; 3] = ["x", "y", "z"];

pub fn all(single: &[NetworkErrors], mixed: &[NetworkErrors]) -> Vec<Chart> {
    let mut charts: Vec<Chart> = (2..=5).map(|photos| errors(single, photos)).collect();
    charts.extend(DISTANCES.map(|distance| improvement(single, distance)));
    let over = |k: usize| mixed.iter().enumerate().map(|(i, o)| [i as f64, o.q[k]]).collect();
    let series = (0..3).map(|k| Series::new(format!("q{}", AXES[k]), over(k))).collect();
    let names: Vec<String> = mixed.iter().map(|o| o.case.name()).collect();
    charts.push(Chart::new("mixed", "network", "standard_error|mm", series).named(names.iter().map(String::as_str)));
    charts
}

/// Standard errors of one number of photos: the types side by side, distance by distance.
fn errors(single: &[NetworkErrors], photos: usize) -> Chart {
    let mut series = Vec::new();
    let mut ticks = Vec::new();
    for (i, distance) in DISTANCES.into_iter().enumerate() {
        // One place is left free between two distances.
        let place = |k: usize| (4 * i + k) as f64;
        let line = |value: &dyn Fn(&NetworkErrors) -> f64| {
            let at = |(k, (kind, _)): (usize, (char, &str))| {
                find(single, distance, photos, kind).map(|o| [place(k), value(o)])
            };
            KINDS.into_iter().enumerate().filter_map(at).collect()
        };
        for (k, axis) in AXES.into_iter().enumerate() {
            series.push(Series::new(format!("q{axis}"), line(&|o| o.q[k])));
        }
        for (k, axis) in AXES.into_iter().enumerate() {
            series.push(Series::new(format!("s_{axis}"), line(&|o| o.s()[k])));
        }
        let named = |(k, (_, name)): (usize, (char, &str))| Tick { at: place(k), text: name.into(), group: false };
        ticks.extend(KINDS.into_iter().enumerate().map(named));
        ticks.push(Tick { at: place(1), text: format!("{distance:.1} m"), group: true });
    }
    let mut chart = Chart::new(format!("errors/{photos}"), "type", "standard_error|mm", series);
    chart.x.ticks = ticks;
    chart
}

/// Falls of M0 and Ms against two photos at one distance.
fn improvement(single: &[NetworkErrors], distance: f64) -> Chart {
    let line = |kind: char, value: Value| {
        let base = find(single, distance, 2, kind).map(value).unwrap_or(f64::NAN);
        let at = |photos: usize| find(single, distance, photos, kind).map(|o| [photos as f64, fall(base, value(o))]);
        (2..=5).filter_map(at).filter(|p| p[1].is_finite()).collect::<Vec<_>>()
    };
    let values: [(&str, Value); 2] = [("m0", NetworkErrors::m0), ("ms", NetworkErrors::ms)];
    let mut series = Vec::new();
    for (id, value) in values {
        series.extend(KINDS.map(|(kind, name)| Series::new(format!("{id}/{name}"), line(kind, value))));
    }
    // What the paper prints of these: all of type A, the first and the last of the others.
    if distance == 2.5 {
        for (kind, points) in [
            ("A", vec![[3.0, 13.5], [4.0, 45.6], [5.0, 49.7]]),
            ("B", vec![[3.0, 14.9], [5.0, 43.8]]),
            ("C", vec![[3.0, 22.5], [5.0, 36.0]]),
        ] {
            series.push(Series { paper: true, ..Series::new(format!("m0/{kind}"), points) });
        }
    }
    let mut chart = Chart::new(format!("improvement/{distance:.1}"), "photos", "improvement|%", series);
    chart.x.ticks = (2..=5).map(|n| Tick { at: f64::from(n), text: n.to_string(), group: false }).collect();
    chart
}
