//! Movement of a group of points as one body.
//!
//! The later place of a point at r from the centroid of the group is modelled as
//!
//! ```text
//! rigid        t + R r            similarity   t + (1 + m) R r          affine   t + r + (Ω + E) r
//! ```
//!
//! with the rotation vector of R, the change of scale m, the antisymmetric Ω (small rotation) and the symmetric strain E; least squares with
//! the full covariance of the displacements (Gauss-Newton; the affine model is linear). With x̂ of u parameters and N = AᵀC⁺A, x̂ᵀNx̂/u is
//! tested against F(u, f), and what remains of Ω against F(rank - u, f).

use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, SymmetricEigen, Vector3};

use super::congruence::pseudo_inverse;
use super::judgement::judged;
use super::request::{Group, GroupModel};
use super::result::{GroupError, GroupMovement, GroupResidual, Tested};

/// Equations whose eigenvalues, at unit lengths, differ by more determine nothing.
const WEAK: f64 = 1e-10;

/// A group's points that are in both epochs: identifiers, earlier coordinates, displacements, and their covariance.
pub struct Members {
    /// Identifiers.
    pub ids: Vec<String>,
    /// Named points that are missing.
    pub missing: Vec<String>,
    /// Earlier coordinates.
    pub xyz: Vec<Vector3<f64>>,
    /// Displacements.
    pub d: Vec<Vector3<f64>>,
    /// Covariance, three rows a point.
    pub covariance: DMatrix<f64>,
}

fn parameters(model: GroupModel) -> (usize, usize) {
    match model {
        GroupModel::Rigid => (6, 3),
        GroupModel::Similarity => (7, 3),
        GroupModel::Affine => (12, 4),
    }
}

/// Movement of a group.
pub fn movement(group: &Group, members: Members, f: Option<f64>, alpha: f64, certain: bool) -> GroupMovement {
    let (count, needed) = parameters(group.model);
    let mut movement = GroupMovement {
        name: group.name.clone(),
        model: group.model,
        points: members.ids.clone(),
        missing: members.missing.clone(),
        centre: None,
        translation: None,
        rotation: None,
        scale: None,
        strain: None,
        test: None,
        fit: None,
        residuals: Vec::new(),
        state: None,
        error: None,
    };
    let given = members.ids.len();
    movement.error = match () {
        () if given < needed => Some(GroupError::TooFewPoints { needed, given }),
        () if !certain => Some(GroupError::NoStableGroup),
        () => solve(group.model, count, &members, f, alpha, &mut movement),
    };
    movement
}

fn solve(
    model: GroupModel,
    count: usize,
    members: &Members,
    f: Option<f64>,
    alpha: f64,
    movement: &mut GroupMovement,
) -> Option<GroupError> {
    let n = members.ids.len();
    let centre = members.xyz.iter().sum::<Vector3<f64>>() / n as f64;
    let r: Vec<Vector3<f64>> = members.xyz.iter().map(|x| x - centre).collect();
    let extent = (r.iter().map(Vector3::norm_squared).sum::<f64>() / n as f64).sqrt();
    if !(extent > 0.0) {
        return Some(GroupError::Undetermined);
    }
    let (weights, rank) = pseudo_inverse(members.covariance.clone());
    // What is determined shows with all parameters as displacements at the extent of the group.
    let unit = |k: usize| if k < 3 { 1.0 } else { 1.0 / extent };
    let (mut t, mut rotation, mut m) = (Vector3::zeros(), Rotation3::identity(), 0.0);
    let mut linear = Matrix3::zeros();
    let mut solution: Option<(DVector<f64>, DMatrix<f64>)> = None;
    for _ in 0..20 {
        let moved = |r: &Vector3<f64>| match model {
            GroupModel::Affine => t + linear * r,
            _ => t + (rotation * r) * (1.0 + m) - r,
        };
        let rest = DVector::from_iterator(3 * n, members.d.iter().zip(&r).flat_map(|(d, r)| (d - moved(r)).data.0[0]));
        let rows: Vec<DMatrix<f64>> = r.iter().map(|r| design(model, count, &(rotation * r * (1.0 + m)), r)).collect();
        let a = DMatrix::from_fn(3 * n, count, |i, j| rows[i / 3][(i % 3, j)] * unit(j));
        let normal = a.transpose() * &weights * &a;
        if !normal.iter().all(|x| x.is_finite()) {
            return Some(GroupError::Undetermined);
        }
        let eigen = SymmetricEigen::new(normal.clone());
        if !(eigen.eigenvalues.min() > WEAK * eigen.eigenvalues.max()) {
            return Some(GroupError::Undetermined);
        }
        let inverse = normal.try_inverse()?;
        let step = &inverse * a.transpose() * &weights * rest;
        let of = |k: usize| step[k] * unit(k);
        t += Vector3::new(of(0), of(1), of(2));
        if model == GroupModel::Affine {
            let turn = Vector3::new(of(3), of(4), of(5)).cross_matrix();
            let e = Matrix3::new(of(6), of(7), of(8), of(7), of(9), of(10), of(8), of(10), of(11));
            linear += turn + e;
        } else {
            rotation = Rotation3::new(Vector3::new(of(3), of(4), of(5))) * rotation;
            if count == 7 {
                m = (1.0 + m) * (1.0 + of(6)) - 1.0;
            }
        }
        let small = step.amax() <= 1e-12 * extent;
        let cofactors = DMatrix::from_fn(count, count, |i, j| inverse[(i, j)] * unit(i) * unit(j));
        solution = Some((DVector::from_fn(count, |k, _| of(k)), cofactors));
        if small || model == GroupModel::Affine {
            break;
        }
    }
    let (_, cofactors) = solution?;
    let mut x = DVector::zeros(count);
    x.fixed_rows_mut::<3>(0).copy_from(&t);
    match model {
        GroupModel::Affine => {
            let (turn, e) = ((linear - linear.transpose()) * 0.5, (linear + linear.transpose()) * 0.5);
            let turn = Vector3::new(turn[(2, 1)], turn[(0, 2)], turn[(1, 0)]);
            x.fixed_rows_mut::<3>(3).copy_from(&turn);
            let e = [e[(0, 0)], e[(0, 1)], e[(0, 2)], e[(1, 1)], e[(1, 2)], e[(2, 2)]];
            e.iter().enumerate().for_each(|(k, e)| x[6 + k] = *e);
        }
        _ => {
            x.fixed_rows_mut::<3>(3).copy_from(&rotation.scaled_axis());
            if count == 7 {
                x[6] = m;
            }
        }
    }
    let tested = |from: usize, length: usize| -> Option<Tested> {
        let part = x.rows(from, length).into_owned();
        let own = cofactors.view((from, from), (length, length)).into_owned();
        let sigma = own.diagonal().iter().map(|q| q.max(0.0).sqrt()).collect();
        let omega = part.dot(&(own.try_inverse()? * &part));
        let value = part.iter().copied().collect();
        Some(Tested { value, sigma, test: judged(omega, length, f, alpha) })
    };
    movement.centre = Some(centre.into());
    movement.translation = tested(0, 3);
    movement.rotation = tested(3, 3);
    movement.scale = if model == GroupModel::Similarity { tested(6, 1) } else { None };
    movement.strain = if model == GroupModel::Affine { tested(6, 6) } else { None };
    movement.test = tested(0, count).map(|all| all.test);
    let moved = |r: &Vector3<f64>| match model {
        GroupModel::Affine => t + linear * r,
        _ => t + (rotation * r) * (1.0 + m) - r,
    };
    let rest: Vec<Vector3<f64>> = members.d.iter().zip(&r).map(|(d, r)| d - moved(r)).collect();
    let stacked = DVector::from_iterator(3 * n, rest.iter().flat_map(|v| v.data.0[0]));
    if rank > count {
        let omega = stacked.dot(&(&weights * &stacked)).max(0.0);
        movement.fit = Some(judged(omega, rank - count, f, alpha));
    }
    let rows: Vec<DMatrix<f64>> = r.iter().map(|r| design(model, count, &(rotation * r * (1.0 + m)), r)).collect();
    let a = DMatrix::from_fn(3 * n, count, |i, j| rows[i / 3][(i % 3, j)]);
    let residual = &members.covariance - &a * &cofactors * a.transpose();
    movement.residuals = (0..n)
        .map(|k| GroupResidual {
            id: members.ids[k].clone(),
            difference: rest[k].into(),
            sigma: std::array::from_fn(|axis| residual[(3 * k + axis, 3 * k + axis)].max(0.0).sqrt()),
        })
        .collect();
    None
}

/// Derivatives of a point's displacement by translation, rotation and the rest; `turned`: R r.
fn design(model: GroupModel, count: usize, turned: &Vector3<f64>, r: &Vector3<f64>) -> DMatrix<f64> {
    let mut rows = DMatrix::zeros(3, count);
    rows.view_mut((0, 0), (3, 3)).fill_with_identity();
    let arm = if model == GroupModel::Affine { r } else { turned };
    rows.view_mut((0, 3), (3, 3)).copy_from(&-arm.cross_matrix());
    match model {
        GroupModel::Rigid => {}
        GroupModel::Similarity => rows.set_column(6, turned),
        GroupModel::Affine => {
            for (column, (i, j)) in [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)].into_iter().enumerate() {
                rows[(i, 6 + column)] += r[j];
                if i != j {
                    rows[(j, 6 + column)] += r[i];
                }
            }
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::initial::robust::{generator, uniform};
    use crate::noise::Noise;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn members(seed: u64, n: usize, motion: impl Fn(&Vector3<f64>) -> Vector3<f64>, sigma: f64) -> Members {
        let mut g = generator(seed);
        let mut noise = Noise::new(seed, 1);
        let xyz: Vec<_> = (0..n).map(|_| Vector3::from_fn(|_, _| 1000.0 * uniform(&mut g))).collect();
        let centre = xyz.iter().sum::<Vector3<f64>>() / n as f64;
        let mut moved = |x: &Vector3<f64>| motion(&(x - centre)) + Vector3::from_fn(|_, _| sigma * noise.normal());
        let d = xyz.iter().map(&mut moved).collect();
        let covariance = DMatrix::identity(3 * n, 3 * n) * sigma.max(0.02).powi(2);
        Members { ids: (0..n).map(|k| k.to_string()).collect(), missing: Vec::new(), xyz, d, covariance }
    }

    fn found(model: GroupModel, members: Members) -> GroupMovement {
        let group = Group { name: "g".into(), points: Vec::new(), model };
        movement(&group, members, None, 0.05, true)
    }

    #[test]
    fn exact_movements_are_found_however_large() {
        let axis = Vector3::new(0.1, -0.05, 0.2);
        let turn = Rotation3::new(axis);
        let shift = Vector3::new(3.0, -8.0, 1.0);
        let rigid = found(GroupModel::Rigid, members(1, 6, |r| shift + turn * r - r, 0.0));
        let value = |tested: &Option<Tested>| tested.as_ref().unwrap().value.clone();
        assert!(value(&rigid.translation).iter().zip(shift.iter()).all(|(a, b)| (a - b).abs() < 1e-9));
        assert!(value(&rigid.rotation).iter().zip(axis.iter()).all(|(a, b)| (a - b).abs() < 1e-12));
        assert!(rigid.fit.unwrap().statistic < 1e-9 && !rigid.test.unwrap().passed);
        let similar = found(GroupModel::Similarity, members(2, 5, |r| shift + turn * r * 1.002 - r, 0.0));
        assert!((value(&similar.scale)[0] - 0.002).abs() < 1e-12);
        let e = Matrix3::new(1e-4, 2e-4, -1e-4, 2e-4, 3e-4, 5e-5, -1e-4, 5e-5, -2e-4);
        let affine = found(GroupModel::Affine, members(3, 8, |r| shift + (axis * 1e-3).cross(r) + e * r, 0.0));
        let expected = [1e-4, 2e-4, -1e-4, 3e-4, 5e-5, -2e-4];
        assert!(value(&affine.strain).iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12));
        assert!(value(&affine.rotation).iter().zip(axis.iter()).all(|(a, b)| (a - 1e-3 * b).abs() < 1e-12));
    }

    /// Of parameters over their standard errors: mean 0 and variance 1, and tests with their nominal rejection rate.
    #[test]
    fn standard_errors_are_those_of_draws() {
        for model in [GroupModel::Rigid, GroupModel::Similarity, GroupModel::Affine] {
            let (mut squares, mut count, mut rejected, mut unfit) = (0.0, 0, 0, 0);
            let runs = 400;
            for seed in 0..runs {
                let one = found(model, members(seed, 7, |_| Vector3::zeros(), 0.05));
                for tested in [&one.translation, &one.rotation, &one.scale, &one.strain].into_iter().flatten() {
                    squares += tested.value.iter().zip(&tested.sigma).map(|(v, s)| (v / s).powi(2)).sum::<f64>();
                    count += tested.value.len();
                }
                rejected += usize::from(!one.test.unwrap().passed);
                unfit += usize::from(!one.fit.unwrap().passed);
            }
            assert!((squares / count as f64 - 1.0).abs() < 0.15, "{model:?}: {}", squares / count as f64);
            // 20 ± 4.4 of 400.
            assert!((4..=38).contains(&rejected) && (4..=38).contains(&unfit), "{model:?}: {rejected} {unfit}");
        }
    }

    #[test]
    fn what_is_not_determined_says_so() {
        let mut line = members(4, 5, |_| Vector3::zeros(), 0.05);
        line.xyz.iter_mut().enumerate().for_each(|(k, x)| *x = Vector3::new(k as f64, 2.0 * k as f64, 0.0));
        assert_eq!(found(GroupModel::Rigid, line).error, Some(GroupError::Undetermined));
        let mut plane = members(5, 6, |_| Vector3::zeros(), 0.05);
        plane.xyz.iter_mut().for_each(|x| x.z = 0.0);
        assert_eq!(found(GroupModel::Affine, plane).error, Some(GroupError::Undetermined));
        let few = found(GroupModel::Affine, members(6, 3, |_| Vector3::zeros(), 0.05));
        assert_eq!(few.error, Some(GroupError::TooFewPoints { needed: 4, given: 3 }));
    }
}
