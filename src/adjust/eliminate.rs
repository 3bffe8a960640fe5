//! Accumulation of the reduced normal equations, point by point: what a kept point adds, what an eliminated one leaves.

use crate::camera::Model;

use super::blocks::{add_product, add_rows, add_square};
use super::kernel::TILE;
use super::layout::Layout;
use super::network::Network;
use super::normal::Normal;
use super::parameters::State;
use super::rows::{Row, Weighting, linearise, point_equations};
use super::tiles::{Line, TileMatrix};
use super::triple::{PointFactor, factor3, forward3};

/// [`add_product`] for a block that may have fewer rows and columns than the arrays, and may belong above the diagonal.
fn add_outer_part<const M: usize, const R: usize, const C: usize>(
    matrix: &mut TileMatrix,
    factor: f64,
    (row, rows): (usize, usize),
    (column, columns): (usize, usize),
    a: &[[f64; R]; M],
    b: &[[f64; C]; M],
) {
    let above = row < column;
    let first = if above { matrix.place(column, row) } else { matrix.place(row, column) };
    let (row_stride, column_stride) = if above { (TILE, 1) } else { (1, TILE) };
    let data = &mut matrix.data_mut()[first..];
    for j in 0..columns {
        for i in 0..rows {
            let sum: f64 = (0..M).map(|m| a[m][i] * b[m][j]).sum();
            data[j * column_stride + i * row_stride] += factor * sum;
        }
    }
}

/// All points' contributions. Returns false where a projection does not exist.
pub fn accumulate<const N: usize>(
    normal: &mut Normal,
    network: &Network,
    layout: &Layout,
    state: &State,
    models: &[Model],
    weighting: Weighting<'_>,
) -> bool {
    let mut rows: Vec<Row<N>> = Vec::new();
    let (mut b, mut columns) = (Vec::new(), Vec::new());
    let mut behind = 0;
    for point in 0..network.points.len() {
        if !linearise(network, state, models, weighting, point, &mut rows, &mut behind) {
            return false;
        }
        let block = &network.points[point];
        let (n, g, cost) = point_equations(block, &state.points[point], &rows);
        normal.cost += cost;
        if block.kept {
            keep(normal, network, layout, layout.point[point], n, g, &rows);
        } else {
            eliminate(normal, network, layout, point, n, g, &rows, &mut b, &mut columns);
        }
    }
    normal.behind = behind;
    true
}

/// Blocks of a point that stays in the reduced equations.
fn keep<const N: usize>(
    normal: &mut Normal,
    network: &Network,
    layout: &Layout,
    place: usize,
    n: [f64; 6],
    g: [f64; 3],
    rows: &[Row<N>],
) {
    for (k, (i, j)) in [(0, 0), (1, 0), (2, 0), (1, 1), (2, 1), (2, 2)].into_iter().enumerate() {
        normal.add(place + i, place + j, n[k]);
    }
    (0..3).for_each(|k| normal.rhs[place + k] -= g[k]);
    for row in rows {
        let photo = (layout.photo[row.photo], 6);
        let interior = (layout.interior[row.interior], network.interiors[row.interior].estimated.len());
        add_outer_part(&mut normal.matrix, 1.0, (place, 3), photo, &row.point, &row.pose);
        add_outer_part(&mut normal.matrix, 1.0, (place, 3), interior, &row.point, &row.interior_rows);
        add_outer_part(&mut normal.matrix, 1.0, interior, photo, &row.interior_rows, &row.pose);
        for (side, e) in row.e.into_iter().enumerate() {
            (0..6).for_each(|k| normal.rhs[photo.0 + k] -= row.pose[side][k] * e);
            (0..interior.1).for_each(|k| normal.rhs[interior.0 + k] -= row.interior_rows[side][k] * e);
        }
        add_own(normal, photo.0, 6, &row.pose);
        add_own(normal, interior.0, interior.1, &row.interior_rows);
    }
}

/// Lower triangle of rowsᵀ·rows, counted in the reference diagonal too.
fn add_own<const C: usize>(normal: &mut Normal, place: usize, length: usize, rows: &[[f64; C]; 2]) {
    for i in 0..length {
        for j in 0..=i {
            normal.add(place + i, place + j, rows[0][i] * rows[0][j] + rows[1][i] * rows[1][j]);
        }
    }
}

#[allow(clippy::too_many_arguments)] // the state of one elimination; a struct would only rename it
#[inline(never)]
fn eliminate<const N: usize>(
    normal: &mut Normal,
    network: &Network,
    layout: &Layout,
    point: usize,
    mut n: [f64; 6],
    g: [f64; 3],
    rows: &[Row<N>],
    b: &mut Vec<[[f64; 3]; 2]>,
    columns: &mut Vec<(u32, u32)>,
) {
    let block = &network.points[point];
    let mut damping = [0.0; 3];
    for a in 0..3 {
        let diagonal = [0, 3, 5][a];
        if block.fixed[a] {
            n[diagonal] = 1.0;
        } else {
            damping[a] = normal.lambda * n[diagonal];
            n[diagonal] += damping[a];
        }
    }
    let (l, lost) = factor3(n);
    if lost {
        normal.eliminated.lost.push(point);
    }
    let h = forward3(&l, g);
    normal.eliminated.factors[point] = PointFactor { l, h, damping };

    b.clear();
    // U = Bᵀ·(interior rows) of the one interior orientation that nearly always sees a point.
    let mut u: [[f64; N]; 3] = [[0.0; N]; 3];
    let single = N > 0 && rows.windows(2).all(|pair| pair[0].interior == pair[1].interior);
    let Normal { matrix, rhs, reference, eliminated, .. } = &mut *normal;
    let z = &mut eliminated.z[block.rays.clone()];
    for (row, z) in rows.iter().zip(&mut *z) {
        let b_row = row.point.map(|a| forward3(&l, a));
        *z = [[0.0; 6]; 3];
        for m in 0..3 {
            let factor = [b_row[0][m], b_row[1][m]];
            add_rows::<false, 2, 6>(&mut z[m], &factor, &row.pose);
            add_rows::<false, 2, N>(&mut u[m], &factor, &row.interior_rows);
        }
        b.push(b_row);
    }
    columns.clear();
    columns.extend(rows.iter().map(|row| TileMatrix::column(layout.photo[row.photo])));
    for (i, row) in rows.iter().enumerate() {
        let place = layout.photo[row.photo];
        let interior = layout.interior[row.interior];
        let e: [f64; 2] =
            std::array::from_fn(|s| row.e[s] - (b[i][s][0] * h[0] + b[i][s][1] * h[1] + b[i][s][2] * h[2]));
        for k in 0..6 {
            rhs[place + k] -= row.pose[0][k] * e[0] + row.pose[1][k] * e[1];
            reference[place + k] += row.pose[0][k] * row.pose[0][k] + row.pose[1][k] * row.pose[1][k];
        }
        // The unused numbers of an interior orientation are zeros, and its block has room for them.
        for (k, (rhs, reference)) in
            rhs[interior..interior + N].iter_mut().zip(&mut reference[interior..interior + N]).enumerate()
        {
            let [x, y] = &row.interior_rows;
            *rhs -= x[k] * e[0] + y[k] * e[1];
            *reference += x[k] * x[k] + y[k] * y[k];
        }
        let line = matrix.line(place);
        // Rays are sorted by place, so that the later one of a pair is the row.
        subtract_pairs(matrix, line, &columns[..i], &z[..=i]);
        let at = line.at(matrix, columns[i]);
        let own = &mut matrix.data_mut()[at..];
        add_square::<false, 2, 6>(own, &row.pose);
        add_square::<true, 3, 6>(own, &z[i]);
        if N > 0 {
            let at = matrix.place(interior, interior);
            add_square::<false, 2, N>(&mut matrix.data_mut()[at..], &row.interior_rows);
        }
        if single {
            // G of the photo times (interior rows - B·U).
            let mut rest = row.interior_rows;
            for (rest, b) in rest.iter_mut().zip(&b[i]) {
                add_rows::<true, 3, N>(rest, b, &u);
            }
            let at = matrix.place(interior, place);
            add_product::<false, 2, N, 6>(&mut matrix.data_mut()[at..], &rest, &row.pose);
        } else if N > 0 {
            add_outer_part(matrix, 1.0, (interior, N), (place, 6), &row.interior_rows, &row.pose);
        }
    }
    match rows.first() {
        Some(row) if single => {
            let place = layout.interior[row.interior];
            if !network.interiors[row.interior].estimated.is_empty() {
                eliminated.set_u(point, 0, &u);
            }
            let at = matrix.place(place, place);
            add_square::<true, 3, N>(&mut matrix.data_mut()[at..], &u);
        }
        _ => mixed_interiors(normal, network, layout, point, rows, b),
    }
}

/// -z_i·z_kᵀ for the last z and every one before it, whose columns are given. This is where the time goes; not inlined, or
/// z_i would not stay in registers.
#[inline(never)]
fn subtract_pairs(matrix: &mut TileMatrix, line: Line, columns: &[(u32, u32)], z: &[[[f64; 6]; 3]]) {
    let Some((last, before)) = z.split_last() else { return };
    for (column, z) in columns.iter().zip(before) {
        let at = line.at(matrix, *column);
        add_product::<true, 3, 6, 6>(&mut matrix.data_mut()[at..], last, z);
    }
}

/// A point seen through several interior orientations: -U_qᵀU_q' among them, -U_qᵀZ_i with the photos.
fn mixed_interiors<const N: usize>(
    normal: &mut Normal,
    network: &Network,
    layout: &Layout,
    point: usize,
    rows: &[Row<N>],
    b: &[[[f64; 3]; 2]],
) {
    let own = normal.eliminated.own(point).to_vec();
    let mut sums: Vec<[[f64; N]; 3]> = vec![[[0.0; N]; 3]; own.len()];
    for (n, (own, u)) in own.iter().zip(&mut sums).enumerate() {
        for (row, b) in rows.iter().zip(b).filter(|(row, _)| row.interior == own.interior) {
            for m in 0..3 {
                for k in 0..N {
                    u[m][k] += row.interior_rows[0][k] * b[0][m] + row.interior_rows[1][k] * b[1][m];
                }
            }
        }
        normal.eliminated.set_u(point, n, u);
    }
    let block = |q: usize| (layout.interior[own[q].interior], own[q].length);
    let Normal { matrix, eliminated, .. } = normal;
    for (q, u) in sums.iter().enumerate() {
        for (other, v) in sums.iter().enumerate() {
            // Each pair once, the one that stands later as the row.
            if block(other).0 <= block(q).0 {
                add_outer_part(matrix, -1.0, block(q), block(other), u, v);
            }
        }
        for (row, z) in rows.iter().zip(&eliminated.z[network.points[point].rays.clone()]) {
            add_outer_part(matrix, -1.0, block(q), (layout.photo[row.photo], 6), u, z);
        }
    }
}
