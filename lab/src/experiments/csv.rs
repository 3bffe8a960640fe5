//! An experiment as CSV files: one for the figures, one a table, one a chart (long form: line, x, y), every digit kept.

use super::outcome::{Cell, Chart, Column, Experiment, Table};
use sightline_exchange::{Files, disarmed};

/// File names and contents.
pub fn csv(experiment: &Experiment) -> Files {
    let number = |value: Option<f64>| value.map(|v| v.to_string()).unwrap_or_default();
    let figures = experiment.figures.iter().map(|f| {
        let [ours, paper, independent] = [Some(f.ours), f.paper, f.independent].map(number);
        vec![f.id.clone(), f.unit.clone(), ours, paper, independent]
    });
    let assumptions = experiment
        .assumptions
        .iter()
        .map(|a| vec![a.id.clone(), a.unit.clone(), number(a.ours), number(a.paper)])
        .collect::<Vec<_>>();
    let mut files = Files::new();
    let mut add = |name: &str, rows: Vec<u8>| {
        files.insert(format!("{}-{}.csv", experiment.name, name.replace('/', "-")), rows);
    };
    add("figures", written(&["figure", "unit", "ours", "paper", "independent"], figures));
    if !assumptions.is_empty() {
        add("assumptions", written(&["assumption", "unit", "ours", "paper"], assumptions));
    }
    for table in &experiment.tables {
        add(&table.id, table_rows(table));
    }
    for chart in &experiment.charts {
        add(&format!("chart-{}", chart.id), chart_rows(chart));
    }
    files
}

fn table_rows(table: &Table) -> Vec<u8> {
    let head = |c: &Column| {
        let unit = if c.unit.is_empty() { String::new() } else { format!(" [{}]", c.unit) };
        format!("{}{}{unit}", if c.paper { "paper " } else { "" }, c.id)
    };
    let head: Vec<String> = table.columns.iter().map(head).collect();
    let cell = |cell: &Cell| match cell {
        Cell::Number(value) => value.to_string(),
        Cell::Text(text) => text.clone(),
        Cell::Empty(()) => String::new(),
    };
    written(&head, table.rows.iter().map(|row| row.iter().map(cell).collect()))
}

fn chart_rows(chart: &Chart) -> Vec<u8> {
    let name = |at: f64, group: bool| {
        let near = chart.x.ticks.iter().filter(|t| t.group == group);
        let limit = if group { 1.5 } else { 0.5 };
        near.min_by(|a, b| (a.at - at).abs().total_cmp(&(b.at - at).abs()))
            .filter(|t| (t.at - at).abs() <= limit)
            .map_or(String::new(), |t| t.text.clone())
    };
    let line = |s: &super::Series| {
        let (id, source) = (s.id.clone(), if s.paper { "paper" } else { "ours" }.to_owned());
        let row = move |p: &[f64; 2]| {
            vec![id.clone(), source.clone(), p[0].to_string(), name(p[0], true), name(p[0], false), p[1].to_string()]
        };
        s.points.iter().map(row).collect::<Vec<_>>()
    };
    let rows: Vec<_> = chart.series.iter().flat_map(line).collect();
    written(&["line", "source", &chart.x.id, "group", "name", &chart.y.id], rows)
}

fn written<H: AsRef<[u8]>>(head: &[H], rows: impl IntoIterator<Item = Vec<String>>) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    // Writing into memory cannot fail, and all rows are as long as the head.
    let _ = writer.write_record(head);
    rows.into_iter().for_each(|row| {
        let _ = writer.write_record(row.iter().map(|field| disarmed(field).into_owned()));
    });
    writer.into_inner().unwrap_or_default()
}
