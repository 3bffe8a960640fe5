//! Kang and Yeu (1985): improvement of coordinates by more photos.
//!
//! Fifteen points on a statue, three of them control, photographed by a P31 with parallel axes from one base line at
//! five distances: 60 networks of 2 to 5 photos at one distance and 16 that mix distances. Q is the geometric standard
//! error √q, S = S0·Q that from the data, M0 and Ms their means over the axes; all means run over the twelve points that are
//! not control. S0 is the root mean square of draws of the noise, each network's own: with one draw, and the same one in all networks,
//! that draw decides whether S lies above Q or below. The paper does not print where the base line lies: here its centre faces
//! the mean of the points.
//!
//! Its conclusion, "3 photos about 15 %, 4 about 35 %, up to about 50 % with 5", is read over the four distances of its
//! figures 4-6 to 4-9 (1.4 to 4.0 m, three types each): the means of 3 and 4 photos and the greatest fall with 5.

mod charts;
mod networks;
mod pairwise;

use super::outcome::{Assumption, Cell, Drawing, Experiment, Figure, Table};
use super::{ExperimentOptions, Progress, step};
pub use networks::PITCH_MM;
use networks::{Case, DISTANCES, network};
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, ResidualPlace, StatisticsChoice};
use sightline::error::{Error, Place, Result, Thing};
use sightline::project::Role;
use sightline_plan::network::{Network, Source, simulate};

/// Standard errors of one network.
struct NetworkErrors {
    case: Case,
    observations: usize,
    unknowns: usize,
    q: [f64; 3],
    /// S0 with its standard error, S0 / √(2 r) of the redundancy r of all draws.
    sigma0: [f64; 2],
}

impl NetworkErrors {
    fn m0(&self) -> f64 {
        self.q.iter().sum::<f64>() / 3.0
    }

    fn s(&self) -> [f64; 3] {
        self.q.map(|q| q * self.sigma0[0])
    }

    fn ms(&self) -> f64 {
        self.m0() * self.sigma0[0]
    }
}

/// The network opened when none is named.
const DEFAULT: &str = "1.4-5A";
/// Draws of the noise of a network: of two photos, with twelve redundant observations, S0 is then good to 6 %.
const DRAWS: u64 = 10;
/// Draws of a network are numbered from here on, network by network, beyond those of the other parts of the experiment.
const FIRST_DRAW: u64 = 100_000;
/// Rounds of Monte Carlo: enough for 3 % of a standard deviation averaged over twelve points.
const ROUNDS: usize = 800;

pub fn run(options: &ExperimentOptions, progress: Progress) -> Result<Experiment> {
    let cases: Vec<Case> = networks::single().into_iter().chain(networks::mixed()).collect();
    let rounds = options.rounds.unwrap_or(ROUNDS);
    let steps = cases.len() + rounds / 50 + 5;
    let mut outcomes = Vec::new();
    for case in cases {
        step(progress, outcomes.len(), steps)?;
        outcomes.push(solve(case, outcomes.len() as u64, options)?);
    }
    let (single, mixed) = outcomes.split_at(networks::single().len());

    let name = options.network.as_deref().unwrap_or(DEFAULT);
    let unknown = || Error::Unknown { kind: Thing::Network, name: name.into(), at: Place::field("network") };
    let opened = outcomes.iter().find(|o| o.case.name() == name).ok_or_else(unknown)?;

    let (scatter, predicted) = monte_carlo(opened, options, rounds, &mut |done| {
        step(progress, single.len() + mixed.len() + done / 50, steps)
    })?;
    let pairwise = pairwise::compare(options, &mut |done| step(progress, steps - 5 + done, steps))?;

    let mut figures = figures(single);
    for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
        figures.push(Figure::new(
            format!("monte_carlo_over_s/{axis}"),
            "%",
            100.0 * (scatter[k] / predicted[k] - 1.0),
            None,
        ));
    }
    let mut charts = charts::all(single, mixed);
    let mut tables = vec![networks_table("single", single), networks_table("mixed", mixed)];
    tables.push(improvement_table(single));
    tables.push(pairwise.table);
    charts.push(pairwise.chart);
    Ok(Experiment {
        name: "kang".into(),
        drawings: drawings(options)?,
        figures,
        tables,
        charts,
        assumptions: vec![
            Assumption::of_kind("base_line_centre"),
            Assumption::of_kind("overall_means"),
            Assumption::of_kind("pairwise_draws"),
            Assumption::new("sigma0_draws", "", DRAWS as f64, 1.0),
        ],
        project: simulate(&network(&opened.case, options))?,
    })
}

/// The network that was chosen, and all photos together.
pub fn drawings(options: &ExperimentOptions) -> Result<Vec<Drawing>> {
    let name = options.network.as_deref().unwrap_or(DEFAULT);
    let unknown = || Error::Unknown { kind: Thing::Network, name: name.into(), at: Place::field("network") };
    let mut cases = networks::single().into_iter().chain(networks::mixed());
    let case = cases.find(|case| case.name() == name).ok_or_else(unknown)?;
    let all = network(&networks::everything(), options);
    Ok(vec![Drawing::of(name, &network(&case, options)), Drawing::of("all", &all)])
}

/// The network that is opened where none is chosen.
pub fn example(options: &ExperimentOptions) -> Network {
    let case = networks::single().into_iter().find(|case| case.name() == DEFAULT);
    network(&case.unwrap_or_else(networks::everything), options)
}

/// √q from the exact geometry, S0 from draws that no other network has.
fn solve(case: Case, number: u64, options: &ExperimentOptions) -> Result<NetworkErrors> {
    let mut network = network(&case, options);
    let exact = simulate(&Network { observations: Source::Exact, ..network.clone() })?;
    let choice =
        |statistics| AdjustOptions { statistics, residuals: ResidualPlace::Corrected, ..AdjustOptions::default() };
    let planned = adjust(&exact, &choice(StatisticsChoice::Precision), &mut |_| true)?;
    let q = planned.precision.as_ref().map_or([f64::NAN; 3], |p| p.mean_q);
    let (mut squares, mut redundancy) = (0.0, 0);
    for draw in 0..DRAWS {
        network.seed = options.seed.wrapping_add(FIRST_DRAW + DRAWS * number + draw);
        let adjustment = adjust(&simulate(&network)?, &choice(StatisticsChoice::None), &mut |_| true)?;
        squares += adjustment.sigma0.map_or(f64::NAN, |sigma0| sigma0 * sigma0) / DRAWS as f64;
        redundancy += adjustment.redundancy;
    }
    let sigma0 = squares.sqrt();
    Ok(NetworkErrors {
        // The paper counts image coordinates only; the weighted control adds nine more here.
        observations: 2 * exact.observations.len(),
        unknowns: planned.unknowns,
        sigma0: [sigma0, sigma0 / (2.0 * redundancy as f64).sqrt()],
        q,
        case,
    })
}

/// Mean over the points of the scatter of coordinates about the truth, per axis, and of the predicted standard errors.
fn monte_carlo(
    outcome: &NetworkErrors,
    options: &ExperimentOptions,
    rounds: usize,
    report: &mut dyn FnMut(usize) -> Result<()>,
) -> Result<([f64; 3], [f64; 3])> {
    let mut network = network(&outcome.case, options);
    let ties: Vec<_> = network.points.iter().filter(|p| p.role == Role::Tie).cloned().collect();
    let mut squares = vec![[0.0; 3]; ties.len()];
    let choice = AdjustOptions {
        statistics: StatisticsChoice::None,
        residuals: ResidualPlace::Corrected,
        ..AdjustOptions::default()
    };
    for round in 0..rounds {
        report(round)?;
        network.seed = options.seed.wrapping_add(1000 + round as u64);
        let adjustment = adjust(&simulate(&network)?, &choice, &mut |_| true)?;
        for (point, sum) in ties.iter().zip(&mut squares) {
            let Some(found) = adjustment.points.iter().find(|p| p.id == point.id) else { continue };
            (0..3).for_each(|k| sum[k] += (found.xyz[k] - point.xyz[k]).powi(2) / rounds as f64);
        }
    }
    let mean = |k: usize| squares.iter().map(|s| s[k].sqrt()).sum::<f64>() / ties.len() as f64;
    // With the true noise equal to the a priori sigma, S0 is 1 and S is Q.
    Ok(([0, 1, 2].map(mean), outcome.q))
}

fn find(single: &[NetworkErrors], distance: f64, photos: usize, kind: char) -> Option<&NetworkErrors> {
    single
        .iter()
        .find(|o| o.case.distance == Some(distance) && o.case.photos.len() == photos && o.case.kind == kind.to_string())
}

/// How many percent smaller `b` is than `a`.
fn fall(a: f64, b: f64) -> f64 {
    100.0 * (1.0 - b / a)
}

/// M0 of a network against two photos of its distance and type; for two photos against B/D 0.2.
fn improvement(single: &[NetworkErrors], outcome: &NetworkErrors) -> Option<f64> {
    let distance = outcome.case.distance?;
    let kind = outcome.case.kind.chars().next()?;
    let base = match outcome.case.photos.len() {
        2 => find(single, distance, 2, 'A')?,
        _ => find(single, distance, 2, kind)?,
    };
    Some(fall(base.m0(), outcome.m0()))
}

fn figures(single: &[NetworkErrors]) -> Vec<Figure> {
    let mut list = Vec::new();
    let mut add = |id: &str,
                   from: (f64, usize, char),
                   to: (f64, usize, char),
                   axis: Option<usize>,
                   paper,
                   independent: Option<f64>| {
        let (Some(a), Some(b)) = (find(single, from.0, from.1, from.2), find(single, to.0, to.1, to.2)) else { return };
        let value = |o: &NetworkErrors| axis.map_or(o.m0(), |k| o.q[k]);
        let figure = Figure::new(id, "%", fall(value(a), value(b)), paper);
        list.push(match independent {
            Some(value) => figure.independent(value),
            None => figure,
        });
    };
    add("base_0.3/1.4", (1.4, 2, 'A'), (1.4, 2, 'B'), None, Some(27.0), Some(25.6));
    add("base_0.4/1.4", (1.4, 2, 'A'), (1.4, 2, 'C'), None, Some(41.0), Some(38.8));
    let axes = ["qx", "qy", "qz"];
    let printed = [('A', [39.5, 45.1, 44.0]), ('B', [35.7, 36.9, 36.3]), ('C', [31.1, 23.9, 27.2])];
    for (kind, paper) in printed {
        for k in 0..3 {
            let independent = (kind == 'A').then(|| [38.2, 44.8, 42.8][k]);
            let id = format!("{}/1.4-5{kind}", axes[k]);
            add(&id, (1.4, 2, kind), (1.4, 5, kind), Some(k), Some(paper[k]), independent);
        }
    }
    let printed = [
        ('A', [Some(13.5), Some(45.6), Some(49.7)], [Some(10.3), Some(43.1), Some(47.4)]),
        ('B', [Some(14.9), None, Some(43.8)], [None; 3]),
        ('C', [Some(22.5), None, Some(36.0)], [None; 3]),
    ];
    for (kind, paper, independent) in printed {
        for k in 0..3 {
            let photos = k + 3;
            let id = format!("m0/2.5-{photos}{kind}");
            add(&id, (2.5, 2, kind), (2.5, photos, kind), None, paper[k], independent[k]);
        }
    }
    // Least and greatest fall over types with five photos: the paper gives ranges.
    for (distance, least, greatest) in [(1.4, 25.9, 44.1), (1.8, 28.0, 44.3)] {
        let falls: Vec<f64> =
            "ABC".chars().filter_map(|kind| improvement(single, find(single, distance, 5, kind)?)).collect();
        let low = falls.iter().copied().fold(f64::INFINITY, f64::min);
        let high = falls.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        list.push(Figure::new(format!("m0_least/{distance}-5"), "%", low, least));
        list.push(Figure::new(format!("m0_greatest/{distance}-5"), "%", high, greatest));
    }
    // The distances of the paper's figures 4-6 to 4-9.
    let charted = |o: &&NetworkErrors| o.case.distance.is_some_and(|d| d < 7.0);
    for (photos, mean_printed, greatest_printed) in
        [(3, Some(15.0), None), (4, Some(35.0), None), (5, None, Some(50.0))]
    {
        let of_count = single.iter().filter(charted).filter(|o| o.case.photos.len() == photos);
        let falls: Vec<f64> = of_count.filter_map(|o| improvement(single, o)).collect();
        let mean = falls.iter().sum::<f64>() / falls.len().max(1) as f64;
        let greatest = falls.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        list.push(Figure::new(format!("m0_mean/{photos}"), "%", mean, mean_printed));
        list.push(Figure::new(format!("m0_up_to/{photos}"), "%", greatest, greatest_printed));
    }
    for (photos, m, n) in [(2, 60.0, 57.0), (3, 90.0, 63.0), (4, 120.0, 69.0), (5, 150.0, 75.0)] {
        let Some(outcome) = find(single, 1.4, photos, 'A') else { continue };
        list.push(Figure::new(format!("observations/{photos}"), "", outcome.observations as f64, m));
        list.push(Figure::new(format!("unknowns/{photos}"), "", outcome.unknowns as f64, n));
    }
    list
}

fn networks_table(id: &str, outcomes: &[NetworkErrors]) -> Table {
    let mut table = Table::new(
        id,
        &[
            "network",
            "photos",
            "m",
            "n",
            "qx|mm|4",
            "qy|mm|4",
            "qz|mm|4",
            "m0|mm|4",
            "s0||3",
            "s0_sigma||3",
            "s_x|mm|4",
            "s_y|mm|4",
            "s_z|mm|4",
            "ms|mm|4",
            "improvement|%|1",
        ],
    );
    for o in outcomes {
        let mut row: Vec<Cell> = vec![o.case.name().as_str().into(), o.case.photos.join(" ").as_str().into()];
        row.extend([o.observations, o.unknowns].map(Cell::from));
        row.extend(o.q.map(Cell::from));
        row.extend([o.m0(), o.sigma0[0], o.sigma0[1]].map(Cell::from));
        row.extend(o.s().map(Cell::from));
        row.extend([Cell::from(o.ms()), improvement(outcomes, o).into()]);
        table.rows.push(row);
    }
    table
}

/// Falls of M0 and Ms with the number of photos, per distance and type.
fn improvement_table(single: &[NetworkErrors]) -> Table {
    let mut table =
        Table::new("improvement", &["distance|m|1", "type", "photos", "m0|%|1", "*m0|%|1", "ms|%|1", "*ms|%|1"]);
    let printed = [((2.5, 'A'), [[13.5, 13.8], [45.6, 52.9], [49.7, 54.1]])];
    for distance in DISTANCES {
        for kind in ['A', 'B', 'C'] {
            for photos in 3..=5 {
                let (Some(base), Some(o)) = (find(single, distance, 2, kind), find(single, distance, photos, kind))
                else {
                    continue;
                };
                let paper =
                    printed.iter().find(|(case, _)| *case == (distance, kind)).map(|(_, list)| list[photos - 3]);
                table.rows.push(vec![
                    distance.into(),
                    kind.to_string().as_str().into(),
                    photos.into(),
                    fall(base.m0(), o.m0()).into(),
                    paper.map(|p| p[0]).into(),
                    fall(base.ms(), o.ms()).into(),
                    paper.map(|p| p[1]).into(),
                ]);
            }
        }
    }
    table
}

/// The network of five photos at 1.4 m, type A.
pub fn default_network(options: &ExperimentOptions) -> Network {
    let cases = networks::single();
    let case = cases.iter().find(|case| case.name() == DEFAULT).unwrap_or(&cases[0]);
    network(case, options)
}
