//! The matrices as files, for homework and for checking with other software.

use std::fmt::Write as _;

use nalgebra::{DMatrix, DVector};

use super::dense::cofactors;
use sightline::adjust::{linearise, normal_equations, npy};
use sightline::adjustment::AdjustOptions;
use sightline::error::Result;
use sightline::project::Project;
use sightline_exchange::Files;

const README: &str = "\
Equations of a bundle adjustment at the values of the project, unscaled: v = A x - l, weights p, normal equations N x = A' P l.

rows.csv     observations: name, value, sigma, unit; a row of A, l, p, v, Qvv each
columns.csv  unknowns: name, value, unit; a column of A, N, Qxx each. Rotations are small turns about the camera axes, radians
reduced.csv  unknowns of S by their column, from 0: what is left after elimination of the points
A.mtx N.mtx S.mtx D.mtx   Matrix Market (scipy.io.mmread); D x = 0 are the datum's constraints, only without control
A.npy N.npy S.npy         the same, dense (numpy.load)
l.npy p.npy b.npy         observed minus computed, weights, A' P l
x.npy v.npy               solution under the constraints and its residuals
Qxx.npy Qvv.npy           cofactors of unknowns and residuals, without sigma0
";
/// Message if the dense matrices are missing.
const LARGE: &str = "\nWith more than 600 unknowns the dense files and those of x, v, Qxx and Qvv are left out.\n";

/// Every matrix at the document's values, by file name.
///
/// # Errors
/// As [`linearise`].
pub fn files(project: &Project, options: &AdjustOptions) -> Result<Files> {
    let (system, normal) = (linearise(project, options)?, normal_equations(project, options)?);
    let mut files = Files::new();
    let mut put = |name: &str, bytes: Vec<u8>| files.insert(name.to_owned(), bytes);
    put("rows.csv", {
        let mut text = "row,name,value,sigma,unit\n".to_owned();
        for (k, row) in system.observations.iter().enumerate() {
            let _ = writeln!(text, "{k},{},{},{},{}", quoted(&row.name), row.value, row.sigma, row.unit);
        }
        text.into_bytes()
    });
    put("columns.csv", {
        let mut text = "column,name,value,unit\n".to_owned();
        for (k, unknown) in system.unknowns.iter().enumerate() {
            let _ = writeln!(text, "{k},{},{},{}", quoted(&unknown.name), unknown.value, unknown.unit);
        }
        text.into_bytes()
    });
    put("reduced.csv", {
        let lines = normal.reduced.unknowns.iter().map(|column| format!("{column}\n"));
        format!("column\n{}", lines.collect::<String>()).into_bytes()
    });
    let vector = |values: &[f64]| npy(values.len(), None, values.iter().copied());
    put("A.mtx", system.a.matrix_market().into_bytes());
    put("N.mtx", normal.n.matrix_market().into_bytes());
    put("S.mtx", normal.reduced.s.matrix_market().into_bytes());
    if system.constraints.rows > 0 {
        put("D.mtx", system.constraints.matrix_market().into_bytes());
    }
    put("l.npy", vector(&system.l));
    put("p.npy", vector(&system.p));
    put("b.npy", vector(&normal.b));
    let q = cofactors(&system);
    put("README.txt", [README, if q.is_none() { LARGE } else { "" }].concat().into_bytes());
    if let Some(q) = q {
        for (name, matrix) in [("A.npy", &system.a), ("N.npy", &normal.n), ("S.npy", &normal.reduced.s)] {
            put(name, dense(&matrix.dense()));
        }
        let a = system.a.dense();
        let x = &q * DVector::from_row_slice(&normal.b);
        let v = &a * &x - DVector::from_row_slice(&system.l);
        put("x.npy", vector(x.as_slice()));
        put("v.npy", vector(v.as_slice()));
        put("Qxx.npy", dense(&q));
        let p = DMatrix::from_diagonal(&DVector::from_iterator(system.p.len(), system.p.iter().map(|p| p.recip())));
        put("Qvv.npy", dense(&(p - &a * &q * a.transpose())));
    }
    Ok(files)
}

fn dense(matrix: &DMatrix<f64>) -> Vec<u8> {
    let rows = (0..matrix.nrows()).flat_map(|i| (0..matrix.ncols()).map(move |j| (i, j)));
    npy(matrix.nrows(), Some(matrix.ncols()), rows.map(|place| matrix[place]))
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}
