//! The equations and iterations that are laid open: the design matrix against numerical derivatives, the normal equations against dense
//! ones, the steps against the adjustment.

use crate::support::networks::{Wanted, brown, exact, noisy, opencv};
use nalgebra::{DMatrix, DVector, Vector3};
use sightline::adjust::{
    Elimination, LinearSystem, UnknownKind, adjust, apply, linearise, normal_equations, start_adjustment,
};
use sightline::adjustment::{AdjustOptions, StatisticsChoice, Termination};
use sightline::noise::Noise;
use sightline::project::{DatumKind, Parameter, Project};
use sightline::rotation;

/// Networks of every kind of observation and datum, some way off their solution.
fn networks() -> Vec<Project> {
    use Parameter as P;
    let mut list = Vec::new();
    for (seed, datum) in [(3, DatumKind::Control), (5, DatumKind::Free), (7, DatumKind::Minimal)] {
        let mut observed = brown(&[P::C, P::X0, P::Y0, P::K1, P::P1, P::B1]);
        observed.sigma = [(P::C, 0.05), (P::K1, 1e-5)].into();
        let mut per_photo = opencv(&[P::F, P::Cx, P::K1]);
        per_photo.per_photo = true;
        for (camera, distances) in [(observed, 0), (opencv(&[P::F, P::Cx, P::Cy, P::K1, P::P2]), 2), (per_photo, 0)] {
            let wanted = Wanted {
                photos: 4,
                points: 12,
                cameras: vec![camera],
                datum,
                control: (4, if seed == 3 && distances == 2 { 0.0 } else { 0.1 }),
                distances: (distances, 0.1),
                centre_sigma: if datum == DatumKind::Control { 2.0 } else { 0.0 },
                ..Wanted::default()
            };
            let mut project = noisy(&exact(&wanted, seed), &mut Noise::new(seed, 1));
            let mut noise = Noise::new(seed, 2);
            for point in project.points.iter_mut().skip(4) {
                point.xyz = point.xyz.map(|xyz| xyz.map(|x| x + noise.normal()));
            }
            list.push(project);
        }
    }
    list
}

/// The document with one unknown changed.
fn changed(project: &Project, system: &LinearSystem, k: usize, by: f64) -> Project {
    let (mut project, unknown) = (project.clone(), &system.unknowns[k]);
    let axis = ["X", "Y", "Z"].iter().position(|axis| unknown.name.ends_with(&format!(" {axis}")));
    match unknown.kind {
        UnknownKind::Rotation => {
            let axis = ["x", "y", "z"].iter().position(|axis| unknown.name.ends_with(&format!(" {axis}")));
            let photo = project.photos.iter_mut().find(|p| Some(&p.id) == unknown.photo.as_ref()).expect("its photo");
            let mut turn = Vector3::zeros();
            turn[axis.expect("an axis")] = by;
            let m = rotation::object_to_camera(photo.rotation.expect("oriented"));
            photo.rotation = Some(rotation::angles(&rotation::turned(&m, turn)));
        }
        UnknownKind::ProjectionCentre => {
            let photo = project.photos.iter_mut().find(|p| Some(&p.id) == unknown.photo.as_ref()).expect("its photo");
            photo.position.as_mut().expect("oriented")[axis.expect("an axis")] += by;
        }
        UnknownKind::Point => {
            let point = project.points.iter_mut().find(|p| Some(&p.id) == unknown.point.as_ref()).expect("the point");
            point.xyz.as_mut().expect("a place")[axis.expect("an axis")] += by;
        }
        UnknownKind::InteriorOrientation => {
            let name = unknown.name.rsplit(' ').next().expect("a name");
            let camera = &mut project.cameras[0];
            let interior = match &unknown.photo {
                None => &mut camera.interior,
                Some(id) => {
                    let photo = project.photos.iter_mut().find(|p| p.id == *id).expect("its photo");
                    photo.interior.get_or_insert(camera.interior)
                }
            };
            let parameter = *interior.parameters().iter().find(|p| p.name() == name).expect("a parameter");
            let value = interior.get(parameter).unwrap_or_default();
            interior.set(parameter, value + by);
        }
    }
    project
}

#[test]
fn the_design_matrix_agrees_with_numerical_derivatives() {
    let options = AdjustOptions::default();
    let mut compared = 0;
    for project in networks() {
        let system = linearise(&project, &options).expect("a sound document");
        let a = system.a.dense();
        assert_eq!((a.nrows(), a.ncols()), (system.observations.len(), system.unknowns.len()));
        for (k, unknown) in system.unknowns.iter().enumerate() {
            let h = unknown.scale * 1e-5;
            let l = |by: f64| linearise(&changed(&project, &system, k, by), &options).expect("a sound document").l;
            let (plus, minus) = (l(h), l(-h));
            let size = a.column(k).amax();
            for (row, equation) in system.observations.iter().enumerate() {
                // Given values of the document are their own initial values: they move with them.
                if equation.given.is_some() && !equation.name.contains(" - ") {
                    continue;
                }
                let numerical = (minus[row] - plus[row]) / (2.0 * h);
                let what = format!("{} by {}: {} {numerical}", equation.name, unknown.name, a[(row, k)]);
                assert!((a[(row, k)] - numerical).abs() <= 2e-6 * size, "{what}");
                compared += usize::from(numerical != 0.0);
            }
        }
    }
    assert!(compared > 5000, "{compared}");
}

#[test]
fn the_normal_equations_are_those_of_dense_matrices() {
    let options = AdjustOptions::default();
    for project in networks() {
        let system = linearise(&project, &options).expect("a sound document");
        let normal = normal_equations(&project, &options).expect("a sound document");
        let (a, p) = (system.a.dense(), DMatrix::from_diagonal(&DVector::from_row_slice(&system.p)));
        let n = a.transpose() * &p * &a;
        let b = a.transpose() * &p * DVector::from_row_slice(&system.l);
        // Unknowns of one size, since their own differ by many powers of ten.
        let size = DVector::from_fn(n.nrows(), |i, _| n[(i, i)].sqrt());
        let close = |x: f64, y: f64, scale: f64| (x - y).abs() <= 1e-12 * scale;
        let found = normal.n.dense();
        for i in 0..n.nrows() {
            assert!(close(normal.b[i], b[i], size[i] * b.component_div(&size).norm()), "{i}");
            assert!((0..n.ncols()).all(|j| close(found[(i, j)], n[(i, j)], size[i] * size[j])), "{i}");
        }
        let kept = &normal.reduced.unknowns;
        let others: Vec<usize> = (0..n.nrows()).filter(|k| !kept.contains(k)).collect();
        let part = |rows: &[usize], columns: &[usize]| {
            DMatrix::from_fn(rows.len(), columns.len(), |i, j| n[(rows[i], columns[j])])
        };
        let inverse = part(&others, &others).try_inverse().expect("points of two rays");
        let s = part(kept, kept) - part(kept, &others) * &inverse * part(&others, kept);
        let found = normal.reduced.s.dense();
        for i in 0..kept.len() {
            let of = |j: usize| size[kept[i]] * size[kept[j]];
            assert!((0..kept.len()).all(|j| (found[(i, j)] - s[(i, j)]).abs() <= 1e-11 * of(j)), "{i}");
        }
        let defect = match (project.datum.kind, project.distances.is_empty()) {
            (DatumKind::Control, _) => 0,
            (_, true) => 7,
            (_, false) => 6,
        };
        assert_eq!((normal.null_space.len(), normal.rank), (defect, n.nrows() - defect));
        for motion in &normal.null_space {
            let v = DVector::from_row_slice(&motion.vector);
            let scaled = v.component_mul(&size).norm();
            assert!((&n * v).component_div(&size).norm() <= 1e-9 * scaled, "{}", motion.name);
        }
        assert!(normal.fill_in.matrix <= normal.fill_in.factor);
        assert!(normal.fill_in.factor <= normal.fill_in.factor_photos_first);
        let sizes: usize = normal.blocks.iter().map(|block| block.size).sum();
        assert_eq!((sizes, normal.elimination_order.len()), (n.nrows(), normal.blocks.len()));
    }
}

#[test]
fn the_cholesky_factor_is_that_of_the_normal_matrix_in_either_order() {
    let options = AdjustOptions::default();
    for project in networks() {
        let normal = normal_equations(&project, &options).expect("a sound document");
        let n = normal.n.dense();
        let size: Vec<f64> = (0..n.nrows()).map(|k| n[(k, k)].sqrt()).collect();
        let counts = [normal.fill_in.factor, normal.fill_in.factor_photos_first];
        for (order, most) in [Elimination::PointsFirst, Elimination::PhotosFirst].into_iter().zip(counts) {
            let factor = normal.cholesky_factor(order).expect("regular but for the datum");
            assert_eq!(factor.held.len(), normal.null_space.len());
            assert!(factor.l.values.len() <= most && factor.l.values.len() == factor.filled.len());
            let l = factor.l.dense();
            let product = &l * l.transpose();
            for (i, row) in factor.order.iter().enumerate() {
                assert!(l.row(i).iter().skip(i + 1).all(|x| *x == 0.0));
                for (j, column) in factor.order.iter().enumerate() {
                    let held = factor.held.contains(row) || factor.held.contains(column);
                    let wanted = if held { f64::from(u8::from(i == j)) } else { n[(*row, *column)] };
                    let scale = if held { 1.0 } else { size[*row] * size[*column] };
                    assert!((product[(i, j)] - wanted).abs() <= 1e-12 * scale, "{order:?} {row} {column}");
                }
                let of_row = factor.l.row_starts[i]..factor.l.row_starts[i + 1];
                for (entry, filled) in factor.l.row(i).zip(&factor.filled[of_row]) {
                    assert_eq!(*filled, n[(*row, factor.order[entry.0])] == 0.0 && entry.0 != i);
                }
            }
        }
        // With the points first the factor ends with that of S.
        if normal.null_space.is_empty() {
            let factor = normal.cholesky_factor(Elimination::PointsFirst).expect("regular");
            let kept = normal.reduced.unknowns.len();
            let first = n.nrows() - kept;
            let place = |k: usize| normal.reduced.unknowns.binary_search(&factor.order[first + k]).expect("of S");
            let s = normal.reduced.s.dense();
            let l = factor.l.dense().view((first, first), (kept, kept)).into_owned();
            let product = &l * l.transpose();
            for i in 0..kept {
                for j in 0..kept {
                    let scale = size[factor.order[first + i]] * size[factor.order[first + j]];
                    assert!((product[(i, j)] - s[(place(i), place(j))]).abs() <= 1e-11 * scale);
                }
            }
        }
    }
}

#[test]
fn steps_are_those_of_the_adjustment() {
    let options = AdjustOptions { statistics: StatisticsChoice::Precision, ..AdjustOptions::default() };
    for project in networks() {
        let mut adjuster = start_adjustment(&project, &options).expect("a sound document");
        let first = adjuster.state().clone();
        if project.datum.kind == DatumKind::Control {
            // The first step is the solution of the normal equations.
            let system = linearise(&project, &options).expect("a sound document");
            let n = system.a.normal(&system.p).dense();
            let size = DVector::from_fn(n.nrows(), |i, _| n[(i, i)].sqrt());
            let scaled = DMatrix::from_fn(n.nrows(), n.ncols(), |i, j| n[(i, j)] / size[i] / size[j]);
            let b = DVector::from_vec(system.a.transposed_times(&system.p, &system.l)).component_div(&size);
            let x = scaled.cholesky().expect("regular").solve(&b).component_div(&size);
            let found = DVector::from_vec(adjuster.step().expect("a step").corrections.clone());
            let off = (&found - &x).component_mul(&size).norm() / x.component_mul(&size).norm();
            assert!(off < 1e-7, "{off}");
            assert_eq!(adjuster.back(), &first);
        }
        let mut steps = 0;
        while adjuster.state().termination.is_none() {
            let state = adjuster.step().expect("a step").clone();
            steps += 1;
            let mut taken = 0;
            let stopped = adjust(&project, &options, &mut |_| {
                taken += 1;
                taken < steps
            });
            let stopped = apply(&project, &stopped.expect("a result"));
            for (one, other) in stopped.points.iter().zip(&state.project.points) {
                let (one, other) = (one.xyz.expect("a place"), other.xyz.expect("a place"));
                assert!((0..3).all(|k| (one[k] - other[k]).abs() <= 1e-9 || state.termination.is_some()), "{steps}");
            }
        }
        let whole = adjuster.finish().expect("a result");
        assert_eq!(adjuster.state().termination, Some(Termination::Converged));
        assert_eq!(whole.iterations.len(), steps);
        let (last, sigma0) = (adjuster.state().sigma0.expect("redundancy"), whole.sigma0.expect("redundancy"));
        assert!((last / sigma0 - 1.0).abs() < 1e-9, "{last} {sigma0}");
        for _ in 0..steps + 2 {
            adjuster.back();
        }
        assert_eq!(adjuster.state(), &first);
    }
}

#[test]
fn numbers_of_a_step_are_those_of_its_equations() {
    let options = AdjustOptions { statistics: StatisticsChoice::Precision, ..AdjustOptions::default() };
    for project in networks() {
        let mut adjuster = start_adjustment(&project, &options).expect("a sound document");
        let mut twin = adjuster.clone();
        while adjuster.state().termination.is_none() {
            twin.step().expect("a step");
            let (system, normal) = adjuster.step_with_numbers().expect("a step");
            assert_eq!(adjuster.state(), twin.state());
            let (all, whole) = twin.equations().expect("equations");
            assert_eq!((&system.a, &system.l, &system.p), (&all.a, &all.l, &all.p));
            assert_eq!((&system.constraints, system.redundancy), (&all.constraints, all.redundancy));
            let values = |system: &LinearSystem| system.observations.iter().map(|row| row.value).collect::<Vec<_>>();
            assert_eq!(values(&system), values(&all));
            assert_eq!((&normal.n, &normal.b, &normal.reduced), (&whole.n, &whole.b, &whole.reduced));
            assert_eq!((&normal.null_space, normal.rank), (&whole.null_space, whole.rank));
            assert!(system.unknowns.iter().all(|unknown| unknown.name.is_empty()));
        }
        // Nothing changes after the last step.
        let (system, _) = adjuster.step_with_numbers().expect("a step");
        assert_eq!((adjuster.state(), &system.a), (twin.state(), &twin.linear_system().expect("equations").a));
    }
}
