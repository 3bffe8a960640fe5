//! The adjustment against plain dense least squares ([`crate::support::dense`]), the datum by the pseudo-inverse's own null space.

use crate::support::dense::{Dense, Unknown};
use crate::support::networks::{Uniform, Wanted, brown, exact, noisy, opencv};
use nalgebra::{DMatrix, DVector};
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment, Given, ResidualPlace, Termination};
use sightline::noise::Noise;
use sightline::project::{DatumKind, Parameter, Project};
use sightline::statistics::distribution::noncentrality;

fn close(got: f64, expected: f64, scale: f64, what: &str) {
    assert!((got - expected).abs() <= 1e-9 * scale, "{what}: {got} against {expected}");
}

/// Compares parameters, cofactors and redundancy numbers.
fn compare(project: &Project, options: &AdjustOptions) {
    let adjustment = adjust(project, options, &mut |_| true).expect("solvable");
    assert_eq!(adjustment.termination, Termination::Converged);
    let dense = Dense::new(project, &adjustment, options.residuals == ResidualPlace::Measured);
    let (a, e) = dense.design();
    assert_eq!(a.nrows(), adjustment.observations_count);
    // Columns of one size, since the parameters' own differ by many powers of ten.
    let size = DVector::from_iterator(a.ncols(), a.column_iter().map(|c| c.norm()));
    let mut scaled = a.clone();
    scaled.column_iter_mut().zip(size.iter()).for_each(|(mut c, s)| c /= *s);
    let normal = scaled.transpose() * &scaled;
    let controlled = project.datum.kind == DatumKind::Control;
    let defect = if controlled {
        0
    } else if project.distances.is_empty() {
        7
    } else {
        6
    };
    assert_eq!(adjustment.constraints, defect);
    let n = a.ncols();
    let redundancy = a.nrows() + defect - dense_unknowns(&adjustment, n);
    assert_eq!(adjustment.redundancy, redundancy);

    // Constraints: the null space on the datum's coordinates, or the held coordinates.
    let mut constraints = DMatrix::zeros(n, defect);
    if defect > 0 {
        let eigen = normal.clone().symmetric_eigen();
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|i, j| eigen.eigenvalues[*i].total_cmp(&eigen.eigenvalues[*j]));
        assert!(eigen.eigenvalues[order[defect]] > 1e-9 && eigen.eigenvalues[order[defect - 1]] < 1e-12);
        let mut held = 0;
        for (k, unknown) in dense.unknowns.iter().enumerate() {
            let Unknown::Point(point, axis) = unknown else { continue };
            let id = &adjustment.points[*point].id;
            let carrier = project.datum.points.as_ref().is_none_or(|list| list.contains(id));
            if project.datum.kind == DatumKind::Minimal {
                if adjustment.points[*point].sigma.expect("full")[*axis] < 1e-12 {
                    constraints[(k, held)] = 1.0;
                    held += 1;
                }
            } else if carrier {
                for (j, at) in order[..defect].iter().enumerate() {
                    // A null vector x/size in the parameters' own units; its constraint back in scaled ones.
                    constraints[(k, j)] = eigen.eigenvectors[(k, *at)] / size[k] / size[k];
                }
            }
        }
        assert!(project.datum.kind != DatumKind::Minimal || held == defect, "{held} coordinates are held");
        let most = constraints.amax();
        constraints /= most;
    }
    let mut bordered = DMatrix::zeros(n + defect, n + defect);
    bordered.view_mut((0, 0), (n, n)).copy_from(&normal);
    bordered.view_mut((0, n), (n, defect)).copy_from(&constraints);
    bordered.view_mut((n, 0), (defect, n)).copy_from(&constraints.transpose());
    let inverse = bordered.try_inverse().expect("regular");
    let q = inverse.view((0, 0), (n, n)).into_owned();
    let scaled_step = -(&q * scaled.transpose() * &e);

    let cost = e.norm_squared();
    let variance = if redundancy > 0 { cost / redundancy as f64 } else { 1.0 };
    close(adjustment.sigma0.expect("redundant"), variance.sqrt(), variance.sqrt(), "sigma0");
    let sigma = |k: usize| (variance * q[(k, k)]).max(0.0).sqrt() / size[k];
    for (k, unknown) in dense.unknowns.iter().enumerate() {
        let step = scaled_step[k] / size[k];
        let magnitude = match unknown {
            Unknown::Photo(_, n) if *n >= 3 => 1.0,
            // Parameters near 0 have no size of their own: a ten-millionth of the standard error.
            Unknown::Camera(..) => 100.0 * sigma(k),
            _ => 1000.0,
        };
        assert!(step.abs() <= 1e-9 * magnitude, "{unknown:?} {} is off by {step}", dense.values[k]);
        let got = match unknown {
            Unknown::Photo(photo, n) if *n < 3 => adjustment.photos[*photo].sigma_position.expect("full")[*n],
            Unknown::Photo(photo, n) => adjustment.photos[*photo].sigma_rotation.expect("full")[n - 3],
            Unknown::Camera(camera, parameter) => adjustment.cameras[*camera].sigma[parameter],
            Unknown::Point(point, axis) => adjustment.points[*point].sigma.expect("full")[*axis],
        };
        close(got, sigma(k), sigma(k).max(1e-6), &format!("sigma of {unknown:?}"));
    }
    for (k, unknown) in dense.unknowns.iter().enumerate() {
        for (j, other) in dense.unknowns.iter().enumerate().skip(k) {
            if let (Unknown::Point(p, a), Unknown::Point(o, b)) = (unknown, other)
                && p == o
            {
                let at = [[0, 1, 2], [1, 3, 4], [2, 4, 5]][*a][*b];
                let expected = variance * q[(k, j)] / size[k] / size[j];
                let scale = (sigma(k) * sigma(j)).max(1e-6);
                close(adjustment.points[*p].covariance.expect("full")[at], expected, scale, "covariance");
            }
        }
    }
    let redundancy_numbers: Vec<f64> = (0..a.nrows())
        .map(|i| {
            let row = scaled.row(i);
            1.0 - (row * &q * row.transpose())[(0, 0)]
        })
        .collect();
    let mut sum = 0.0;
    let enabled = adjustment.observations.iter().filter(|o| o.enabled);
    let ours: Vec<f64> = enabled
        .flat_map(|o| [o.rx.expect("full"), o.ry.expect("full")])
        .chain(adjustment.given.iter().map(|g| g.reliability.expect("full").redundancy))
        .collect();
    assert_eq!(ours.len(), redundancy_numbers.len());
    for (k, (got, expected)) in ours.iter().zip(&redundancy_numbers).enumerate() {
        close(*got, *expected, 1.0, &format!("redundancy number {k}"));
        sum += got;
    }
    close(sum, redundancy as f64, redundancy as f64, "sum of the redundancy numbers");
    compare_effects(project, &adjustment, &dense, &redundancy_numbers, &|i| {
        (&q * scaled.row(i).transpose()).component_div(&size)
    });
}

/// External reliability: the detectable bias of every observation through Q aᵀ, and how far that moves its points.
fn compare_effects(
    project: &Project,
    adjustment: &Adjustment,
    dense: &Dense<'_>,
    redundancy_numbers: &[f64],
    shifts: &dyn Fn(usize) -> DVector<f64>,
) {
    let largest = |row: usize, points: &[&str]| -> Option<(f64, String)> {
        let r = redundancy_numbers[row];
        if r <= 1e-9 {
            return None;
        }
        let shifts = shifts(row) * (noncentrality() / r.sqrt());
        let moved = |id: &&str| {
            let square = |(k, unknown): (usize, &Unknown)| match unknown {
                Unknown::Point(point, _) if adjustment.points[*point].id == *id => shifts[k] * shifts[k],
                _ => 0.0,
            };
            (dense.unknowns.iter().enumerate().map(square).sum::<f64>().sqrt(), (*id).to_owned())
        };
        points.iter().map(moved).max_by(|a, b| a.0.total_cmp(&b.0))
    };
    // Beside the a priori size of the bias where it moves nothing.
    let agree = |got: Option<f64>, expected: Option<f64>, what: &str| {
        assert_eq!(got.is_some(), expected.is_some(), "{what}");
        let (got, expected) = (got.unwrap_or_default(), expected.unwrap_or_default());
        close(got, expected, expected.abs().max(1.0), &format!("effect of {what}"));
    };
    let enabled: Vec<_> = adjustment.observations.iter().filter(|o| o.enabled).collect();
    for (k, o) in enabled.iter().enumerate() {
        for (side, got) in [o.effect_x, o.effect_y].into_iter().enumerate() {
            let expected = largest(2 * k + side, &[&o.point]).map(|(shift, _)| shift);
            agree(got, expected, &format!("{} in {}", o.point, o.photo));
        }
    }
    for (k, given) in adjustment.given.iter().enumerate() {
        let camera = |photo: &str| &project.photos.iter().find(|p| p.id == photo).expect("known").camera;
        let seen = |wanted: &dyn Fn(&str) -> bool| -> Vec<&str> {
            enabled.iter().filter(|o| wanted(&o.photo)).map(|o| o.point.as_str()).collect()
        };
        let points = match &given.what {
            Given::Control { point, .. } => vec![point.as_str()],
            Given::Distance { from, to } => vec![from.as_str(), to.as_str()],
            Given::Position { photo, .. } | Given::Parameter { photo: Some(photo), .. } => seen(&|id| id == photo),
            Given::Parameter { camera: own, photo: None, .. } => seen(&|id| camera(id) == own),
        };
        let expected = largest(2 * enabled.len() + k, &points);
        agree(given.effect, expected.as_ref().map(|e| e.0), &format!("{:?}", given.what));
        if let (Some((shift, point)), Some(named)) = (expected, &given.effect_point) {
            let of_named = largest(2 * enabled.len() + k, &[named]).map_or(0.0, |(shift, _)| shift);
            assert!(*named == point || (shift - of_named) <= 1e-9 * shift.max(1.0), "{named} is not {point}");
        }
    }
}

fn dense_unknowns(adjustment: &Adjustment, n: usize) -> usize {
    assert_eq!(adjustment.unknowns, n);
    n
}

fn run(wanted: &Wanted, seeds: std::ops::Range<u64>) {
    for seed in seeds {
        let mut noise = Noise::new(seed, 3);
        let mut project = noisy(&exact(wanted, seed), &mut noise);
        // Some rays are missing, and sigmas differ.
        let mut random = Uniform(seed + 100);
        project.observations.retain(|_| random.between(0.0, 1.0) > 0.15);
        for place in [ResidualPlace::Corrected, ResidualPlace::Measured] {
            compare(&project, &AdjustOptions { residuals: place, ..AdjustOptions::default() });
        }
    }
}

const MANY: [Parameter; 7] =
    [Parameter::C, Parameter::X0, Parameter::Y0, Parameter::K1, Parameter::K2, Parameter::P1, Parameter::B1];

#[test]
fn free_networks_agree_with_dense_least_squares() {
    run(&Wanted::default(), 0..3);
    let some = (2..9).map(|k| format!("p{k}")).collect();
    let well_determined = [Parameter::C, Parameter::K1, Parameter::P1];
    run(&Wanted { datum_points: Some(some), cameras: vec![brown(&well_determined)], ..Wanted::default() }, 3..5);
    run(&Wanted { distances: (2, 0.05), ..Wanted::default() }, 5..7);
}

#[test]
fn minimal_datums_agree_with_dense_least_squares() {
    run(&Wanted { datum: DatumKind::Minimal, ..Wanted::default() }, 10..12);
    run(&Wanted { datum: DatumKind::Minimal, distances: (1, 0.1), ..Wanted::default() }, 12..14);
    let chosen = Some(["p1", "p5", "p7"].map(String::from).to_vec());
    run(&Wanted { datum: DatumKind::Minimal, datum_points: chosen, ..Wanted::default() }, 14..16);
}

#[test]
fn controlled_networks_agree_with_dense_least_squares() {
    let control = |control| Wanted { datum: DatumKind::Control, control, ..Wanted::default() };
    run(&control((5, 0.0)), 20..22);
    run(&control((5, 0.1)), 22..24);
    run(&Wanted { centre_sigma: 0.5, distances: (1, 0.05), ..control((3, 0.2)) }, 24..26);
    run(&Wanted { centre_sigma: 1.0, ..control((0, 0.0)) }, 26..28);
}

#[test]
fn every_choice_of_cameras_agrees_with_dense_least_squares() {
    let opencv_free = [Parameter::F, Parameter::Cx, Parameter::Cy, Parameter::K1, Parameter::P1];
    run(&Wanted { cameras: vec![opencv(&opencv_free)], ..Wanted::default() }, 30..32);
    let separate = [Parameter::Fx, Parameter::Fy, Parameter::K1, Parameter::K2];
    run(&Wanted { photos: 8, cameras: vec![brown(&MANY), opencv(&separate)], ..Wanted::default() }, 32..34);
    let mut observed = brown(&[Parameter::C, Parameter::K1]);
    observed.sigma = [(Parameter::C, 0.01), (Parameter::X0, 0.02), (Parameter::Y0, 0.02)].into();
    run(&Wanted { cameras: vec![observed], ..Wanted::default() }, 34..36);
    let mut own = brown(&[Parameter::C, Parameter::X0]);
    own.per_photo = true;
    run(&Wanted { points: 24, cameras: vec![own.clone()], ..Wanted::default() }, 36..38);
    let mut own_observed = own.clone();
    own_observed.sigma = [(Parameter::C, 0.02), (Parameter::Y0, 0.03)].into();
    run(&Wanted { points: 24, cameras: vec![own_observed], distances: (2, 0.1), ..Wanted::default() }, 42..44);
    run(
        &Wanted { points: 24, cameras: vec![own, opencv(&[Parameter::F])], distances: (1, 0.1), ..Wanted::default() },
        38..40,
    );
    run(&Wanted { cameras: vec![brown(&[])], ..Wanted::default() }, 40..42);
}

/// Photos around the object that share points with their neighbours alone: most tiles of the reduced equations are absent.
#[test]
fn a_chain_of_photos_agrees_with_dense_least_squares() {
    let wanted = Wanted { photos: 40, points: 60, ..Wanted::default() };
    for datum in [DatumKind::Free, DatumKind::Minimal] {
        let mut project = noisy(&exact(&Wanted { datum, ..wanted.clone() }, 50), &mut Noise::new(50, 3));
        let number = |id: &str| id[1..].parse::<f64>().expect("numbered");
        project.observations.retain(|o| (number(&o.photo) / 40.0 - number(&o.point) / 60.0).abs() < 0.15);
        for residuals in [ResidualPlace::Corrected, ResidualPlace::Measured] {
            compare(&project, &AdjustOptions { residuals, ..AdjustOptions::default() });
        }
    }
}
