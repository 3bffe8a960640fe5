//! Numbers of tables rounded to two digits of their standard error.

use super::ResultTable;

/// A value rounded to two digits of its standard error, without one to twelve digits. Very small numbers are written with an exponent.
pub fn digits(value: f64, sigma: Option<f64>) -> String {
    let Some(sigma) = sigma.filter(|sigma| sigma.is_finite() && *sigma > 0.0) else { return significant(value, 12) };
    let decimals = 1.0 - sigma.log10().floor();
    if decimals <= 9.0 {
        return format!("{value:.*}", decimals.max(0.0) as usize);
    }
    let leading = if value == 0.0 { -decimals } else { value.abs().log10().floor() };
    format!("{value:.*e}", (leading + decimals).clamp(0.0, 15.0) as usize)
}

/// A number rounded to `digits` significant digits.
pub fn significant(value: f64, digits: usize) -> String {
    let rounded: f64 = format!("{value:.*e}", digits - 1).parse().unwrap_or(value);
    if rounded != 0.0 && rounded.abs() < 1e-6 { format!("{rounded:e}") } else { rounded.to_string() }
}

/// A column heading without its unit.
fn bare(heading: &str) -> &str {
    heading.split('[').next().unwrap_or_default().trim()
}

/// Rounds the numbers of a table: by their standard error if the table has a column for it, else to six digits. Columns of names are not
/// changed.
pub(super) fn round(table: &mut ResultTable) {
    let Some((heading, rows)) = table.rows.split_first_mut() else { return };
    let numbers = ["rx", "ry", "wx", "wy", "value", "sigma", "difference"];
    let number = |name: &String| name.contains('[') || numbers.contains(&name.as_str());
    let names: Vec<&str> = heading.iter().map(|name| bare(name)).collect();
    let error = |name: &str| {
        let own = [format!("s{name}"), format!("s_{name}"), format!("sigma_{name}")];
        let beside = matches!(name, "value" | "difference").then(|| "sigma".to_owned());
        names.iter().position(|other| own.iter().chain(&beside).any(|own| own == other))
    };
    let is_error = |k: usize| (0..names.len()).any(|of| error(names[of]) == Some(k));
    let rules: Vec<Option<Option<usize>>> = (0..heading.len())
        .map(|k| number(&heading[k]).then(|| if is_error(k) { Some(k) } else { error(names[k]) }))
        .collect();
    for row in rows {
        let before = row.clone();
        for (k, rule) in rules.iter().enumerate() {
            let (Some(rule), Some(Ok(value))) = (rule, before.get(k).map(|text| text.parse::<f64>())) else { continue };
            let sigma = rule.and_then(|of| before.get(of)).and_then(|text| text.parse::<f64>().ok());
            row[k] = match (sigma, rule) {
                (Some(_), _) => digits(value, sigma),
                // A value whose own standard error is missing is not rounded further.
                (None, Some(_)) => significant(value, 12),
                (None, None) => significant(value, 6),
            };
        }
    }
}
