//! Observations of other kinds than image coordinates: control, projection centres, distances, camera parameters.

use crate::view::components::given::{given_kind, given_name};
use leptos::prelude::*;
use sightline::adjustment::{Given, GivenObservation};

use super::read;
use crate::format;
use crate::i18n::text;
use crate::store::Desk;
use crate::view::components::parameters::parameter_unit;
use crate::view::components::table::{Cell, Column, CopyButton, NumberTable, Row, Sorting};
use crate::view::components::units::length_unit;
use crate::view::components::units::unit_of;

#[component]
pub(super) fn GivenTable() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sorting = RwSignal::new(Some(Sorting { column: 6, descending: true }));
    let columns = Signal::derive(move || {
        let unit = desk.document.with(length_unit);
        vec![
            Column::words(text::id),
            Column::words(text::kind_of_observation),
            Column::words(text::unit),
            Column::number(|| "v"),
            Column::number(|| "σ"),
            Column::number(|| "r"),
            Column::number(|| "w"),
            Column::number(text::detectable),
            Column::number(text::effect).unit(unit),
            Column::words(text::effect_on),
        ]
    });
    let rows = Memo::new(move |_| {
        read(desk, |a, project| {
            let row = |(k, given): (usize, &GivenObservation)| {
                let unit = match &given.what {
                    Given::Parameter { camera, parameter, .. } => {
                        let camera = project.cameras.iter().find(|c| c.id == *camera);
                        camera.map(|camera| parameter_unit(camera, *parameter)).unwrap_or_default()
                    }
                    _ => unit_of(a, project),
                };
                let decimals = format::decimals_for(given.sigma);
                let test = given.reliability.unwrap_or_default();
                let over = test.w.is_some_and(|w| w.abs() > a.criteria.w);
                let mut size = Cell::number(test.w, 2).class(if over { "bad" } else { "" });
                size.order = test.w.map(f64::abs);
                let redundancy = given.reliability.map(|r| r.redundancy);
                let unchecked = redundancy.is_some_and(|r| r < a.criteria.unchecked);
                let number = |value: Option<f64>, decimals| Cell::number(value.filter(|_| !unchecked), decimals);
                let mut checked = Cell::number(redundancy, redundancy.map_or(2, |r| format::decimals_of(r, 2)));
                if unchecked {
                    checked.instead = Some(text::unchecked());
                    size = Cell::number(None, 2);
                }
                let effect = given.effect.map_or(3, format::decimals_for);
                Row {
                    key: k.to_string(),
                    cells: vec![
                        Cell::id(&given_name(&given.what)),
                        Cell::words(given_kind(&given.what)),
                        Cell::words(unit),
                        number(given.residual, given.residual.map_or(decimals, |v| format::decimals_of(v, decimals))),
                        Cell::number(Some(given.sigma), decimals),
                        checked,
                        size,
                        number(test.mdb, decimals),
                        number(given.effect, effect),
                        Cell::words(given.effect_point.clone().filter(|_| !unchecked).unwrap_or_default()),
                    ],
                    off: !given.enabled,
                }
            };
            a.given.iter().enumerate().map(row).collect::<Vec<_>>()
        })
    });
    let chosen = RwSignal::new(None::<String>);
    let choose = Callback::new(move |key: String| {
        let point = key.parse().ok().and_then(|k: usize| {
            read(desk, |a, _| match a.given.get(k).map(|given| &given.what) {
                Some(Given::Control { point, .. }) => Some(point.clone()),
                _ => None,
            })
        });
        if let Some(point) = point {
            desk.select_point(&point);
        }
        chosen.set(Some(key));
    });
    view! {
        <Show when=move || rows.with(|rows| !rows.is_empty())>
            <h2 class="section-head">
                <span>{text::other_observations} " " <span class="id">{move || rows.with(Vec::len)}</span></span>
                <CopyButton columns rows/>
            </h2>
            <NumberTable label=text::other_observations columns rows chosen on_choose=choose sorting class="given"/>
        </Show>
    }
}
