//! Accumulation of the reduced normal equations, point by point: what a kept point adds, what an eliminated one leaves.

use crate::adjust::linear::blocks::{add_lower, add_product, add_rows, add_squares};
use crate::adjust::linear::cholesky3::{PointFactor, factor3, forward3};
use crate::adjust::linear::kernel::TILE;
use crate::adjust::linear::tiles::{TileMatrix, TileRow};
use crate::adjust::problem::network::{PhotoBlock, PointBlock};

use super::collinearity::{CollinearityRows, Linearisation, point_equations};
use super::context::Context;
use super::normal::ReducedNormalEquations;
use super::ordering::Layout;

/// [`add_product`] for a block that may have fewer rows and columns than the arrays, and may belong above the diagonal.
fn add_outer_part<const M: usize, const R: usize, const C: usize>(
    matrix: &mut TileMatrix,
    factor: f64,
    (row, rows): (usize, usize),
    (column, columns): (usize, usize),
    a: &[[f64; R]; M],
    b: &[[f64; C]; M],
) {
    // An interior orientation that is held may stand after the last tile.
    if rows == 0 || columns == 0 {
        return;
    }
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

/// Offsets of a photo's unknowns.
struct PhotoOffsets {
    /// In the vectors.
    row: usize,
    line: TileRow,
    column: (u32, u32),
    /// Its own block in the matrix.
    own: usize,
    interior: Shared,
}

/// Where the numbers of a photo's interior orientation stand.
#[derive(Clone, Copy)]
struct Shared {
    row: usize,
    /// Its own block in the matrix.
    own: usize,
    /// Its block with the photo.
    cross: usize,
}

fn places<const N: usize>(matrix: &TileMatrix, Context { network, layout, .. }: Context<'_>) -> Vec<PhotoOffsets> {
    let place = |(photo, &row): (&PhotoBlock, &usize)| {
        let interior = layout.interior[photo.interior];
        let at = |column: usize| if N > 0 { matrix.place(interior, column) } else { 0 };
        PhotoOffsets {
            row,
            line: matrix.line(row),
            column: TileMatrix::column(row),
            own: matrix.place(row, row),
            interior: Shared { row: interior, own: at(interior), cross: at(row) },
        }
    };
    network.photos.iter().zip(&layout.photo).map(place).collect()
}

/// Elimination of a point, terms of one ray: rows of B = A·L⁻ᵀ, and residuals after the point's own step, e - Bh.
#[derive(Clone, Copy)]
struct ReducedRay {
    b: [[f64; 3]; 2],
    e: [f64; 2],
}

/// Terms of a point's elimination, ray by ray.
#[derive(Default)]
struct RayEliminations {
    columns: Vec<(u32, u32)>,
    reduced: Vec<ReducedRay>,
    /// Zᵀ = BᵀG over the photo's unknowns.
    z: Vec<[[f64; 6]; 3]>,
}

/// All points' contributions. `None` if a projection does not exist.
pub fn accumulate<const N: usize>(normal: &mut ReducedNormalEquations, context: Context<'_>) -> Option<()> {
    let Context { network, layout, state, .. } = context;
    let linearisation = Linearisation::<N>::new(context)?;
    let places = places::<N>(&normal.matrix, context);
    let (mut room, mut parts) = (Vec::new(), RayEliminations::default());
    let mut behind = 0;
    for (point, block) in network.points.iter().enumerate() {
        let rows = linearisation.point(point, &mut room, &mut behind)?;
        let (n, g, cost) = point_equations(block, &state.points[point], rows);
        normal.cost += cost;
        if block.kept {
            keep(normal, context, layout.point[point], n, g, rows);
            continue;
        }
        factor_point(normal, block, point, n, g);
        photo_parts(normal, block, point, rows, &places, &mut parts);
        if N > 0 {
            let single = rows.windows(2).all(|pair| pair[0].interior == pair[1].interior);
            match rows.first() {
                Some(row) if single => {
                    let u = interior_parts(normal, rows, &places, &parts.reduced);
                    if !network.interiors[row.interior].estimated.is_empty() {
                        normal.eliminated.set_u(point, 0, &u);
                    }
                }
                _ => mixed_interiors(normal, layout, point, rows, &parts),
            }
        }
    }
    normal.behind = behind;
    Some(())
}

/// Blocks of a point that stays in the reduced equations.
fn keep<const N: usize>(
    normal: &mut ReducedNormalEquations,
    Context { network, layout, .. }: Context<'_>,
    place: usize,
    n: [f64; 6],
    g: [f64; 3],
    rows: &[CollinearityRows<N>],
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
fn add_own<const C: usize>(normal: &mut ReducedNormalEquations, place: usize, length: usize, rows: &[[f64; C]; 2]) {
    for i in 0..length {
        for j in 0..=i {
            normal.add(place + i, place + j, rows[0][i] * rows[0][j] + rows[1][i] * rows[1][j]);
        }
    }
}

/// The point's own elimination: L and h.
fn factor_point(normal: &mut ReducedNormalEquations, block: &PointBlock, point: usize, mut n: [f64; 6], g: [f64; 3]) {
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
}

/// Blocks of an eliminated point's photos, and what goes on to the interior orientations.
#[inline(never)]
fn photo_parts<const N: usize>(
    normal: &mut ReducedNormalEquations,
    block: &PointBlock,
    point: usize,
    rows: &[CollinearityRows<N>],
    places: &[PhotoOffsets],
    RayEliminations { columns, reduced, z }: &mut RayEliminations,
) {
    let ReducedNormalEquations { matrix, rhs, reference, eliminated, .. } = normal;
    let factor = &eliminated.factors[point];
    let by_shift = &mut eliminated.by_shift[block.rays.clone()];
    columns.clear();
    reduced.clear();
    z.resize(rows.len().max(z.len()), [[0.0; 6]; 3]);
    for (i, (row, by_shift)) in rows.iter().zip(by_shift).enumerate() {
        let place = &places[row.photo];
        let vectors = (&mut rhs[place.row..], &mut reference[place.row..]);
        *by_shift = row.pose.map(|[_, _, _, x, y, z]| [x, y, z]);
        reduced.push(photo_part(factor, row, &mut z[i], &mut matrix.data_mut()[place.own..], vectors));
        // Rays are sorted by place, so that the later one of a pair is the row.
        subtract_pairs(matrix, place.line, columns, &z[..=i]);
        columns.push(place.column);
    }
}

/// Z = GᵀB and the photo's own GᵀG - ZZᵀ = Gᵀ(G - BZᵀ).
#[inline(never)]
fn photo_part<const N: usize>(
    factor: &PointFactor,
    row: &CollinearityRows<N>,
    z: &mut [[f64; 6]; 3],
    own: &mut [f64],
    (rhs, reference): (&mut [f64], &mut [f64]),
) -> ReducedRay {
    let h = &factor.h;
    let b = row.point.map(|a| forward3(&factor.l, a));
    let mut columns = [[0.0; 6]; 3];
    for m in 0..3 {
        add_rows::<false, 2, 6>(&mut columns[m], &[b[0][m], b[1][m]], &row.pose);
    }
    let mut rest = row.pose;
    for (rest, b) in rest.iter_mut().zip(&b) {
        add_rows::<true, 3, 6>(rest, b, &columns);
    }
    *z = columns;
    add_lower::<2, 6>(own, &rest, &row.pose);
    let e = std::array::from_fn(|s| row.e[s] - (b[s][0] * h[0] + b[s][1] * h[1] + b[s][2] * h[2]));
    add_rows::<true, 2, 6>(rhs, &e, &row.pose);
    add_squares::<2, 6>(reference, &row.pose);
    ReducedRay { b, e }
}

/// Blocks of the one interior orientation that nearly always sees a point: with U = CᵀB, CᵀC - UUᵀ = Cᵀ(C - BUᵀ), and
/// (C - BUᵀ)ᵀG with the photos. Returns U.
#[inline(never)]
fn interior_parts<const N: usize>(
    normal: &mut ReducedNormalEquations,
    rows: &[CollinearityRows<N>],
    places: &[PhotoOffsets],
    reduced: &[ReducedRay],
) -> [[f64; N]; 3] {
    let mut u: [[f64; N]; 3] = [[0.0; N]; 3];
    for (row, ReducedRay { b, .. }) in rows.iter().zip(reduced) {
        for m in 0..3 {
            add_rows::<false, 2, N>(&mut u[m], &[b[0][m], b[1][m]], &row.interior_rows);
        }
    }
    for (row, reduced) in rows.iter().zip(reduced) {
        interior_part(normal, row, reduced, &places[row.photo].interior, &u);
    }
    u
}

#[inline(never)]
fn interior_part<const N: usize>(
    normal: &mut ReducedNormalEquations,
    row: &CollinearityRows<N>,
    ReducedRay { b, e }: &ReducedRay,
    at: &Shared,
    u: &[[f64; N]; 3],
) {
    let mut rest = row.interior_rows;
    for (rest, b) in rest.iter_mut().zip(b) {
        add_rows::<true, 3, N>(rest, b, u);
    }
    let data = normal.matrix.data_mut();
    add_lower::<2, N>(&mut data[at.own..], &rest, &row.interior_rows);
    add_product::<false, 2, N, 6>(&mut data[at.cross..], &rest, &row.pose);
    add_rows::<true, 2, N>(&mut normal.rhs[at.row..], e, &row.interior_rows);
    add_squares::<2, N>(&mut normal.reference[at.row..], &row.interior_rows);
}

/// -z_i·z_kᵀ for the last z and every one before it, whose columns are given. This is where the time goes; not inlined, or
/// z_i would not stay in registers.
#[inline(never)]
fn subtract_pairs(matrix: &mut TileMatrix, line: TileRow, columns: &[(u32, u32)], z: &[[[f64; 6]; 3]]) {
    let Some((last, before)) = z.split_last() else { return };
    for (column, z) in columns.iter().zip(before) {
        let at = line.at(matrix, *column);
        add_product::<true, 3, 6, 6>(&mut matrix.data_mut()[at..], last, z);
    }
}

/// A point seen through several interior orientations: CᵀC of each and CᵀG with its photos, then -U_qᵀU_q' among them and
/// -U_qᵀZ_i with all photos.
fn mixed_interiors<const N: usize>(
    normal: &mut ReducedNormalEquations,
    layout: &Layout,
    point: usize,
    rows: &[CollinearityRows<N>],
    RayEliminations { reduced, z, .. }: &RayEliminations,
) {
    for (row, ReducedRay { e, .. }) in rows.iter().zip(reduced) {
        let (photo, interior) = (layout.photo[row.photo], layout.interior[row.interior]);
        let own = normal.matrix.place(interior, interior);
        add_lower::<2, N>(&mut normal.matrix.data_mut()[own..], &row.interior_rows, &row.interior_rows);
        add_outer_part(&mut normal.matrix, 1.0, (interior, N), (photo, 6), &row.interior_rows, &row.pose);
        add_rows::<true, 2, N>(&mut normal.rhs[interior..], e, &row.interior_rows);
        add_squares::<2, N>(&mut normal.reference[interior..], &row.interior_rows);
    }
    let own = normal.eliminated.own(point).to_vec();
    let mut sums: Vec<[[f64; N]; 3]> = vec![[[0.0; N]; 3]; own.len()];
    for (n, (own, u)) in own.iter().zip(&mut sums).enumerate() {
        for (row, ReducedRay { b, .. }) in rows.iter().zip(reduced).filter(|(row, _)| row.interior == own.interior) {
            for m in 0..3 {
                for k in 0..N {
                    u[m][k] += row.interior_rows[0][k] * b[0][m] + row.interior_rows[1][k] * b[1][m];
                }
            }
        }
        normal.eliminated.set_u(point, n, u);
    }
    let block = |q: usize| (layout.interior[own[q].interior], own[q].length);
    let matrix = &mut normal.matrix;
    for (q, u) in sums.iter().enumerate() {
        for (other, v) in sums.iter().enumerate() {
            // Each pair once, the one that stands later as the row.
            if block(other).0 <= block(q).0 {
                add_outer_part(matrix, -1.0, block(q), block(other), u, v);
            }
        }
        for (row, z) in rows.iter().zip(z) {
            add_outer_part(matrix, -1.0, block(q), (layout.photo[row.photo], 6), u, z);
        }
    }
}
