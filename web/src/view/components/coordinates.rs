//! Coordinates with their standard errors as cells of a table, in the order of the user's axes.

use leptos::prelude::*;
use sightline::axes::{ShownAxes, UserAxes};
use sightline::project::{Point, Role};

use crate::format;
use crate::i18n::text;
use crate::store::Desk;

/// How coordinates can be shown, by the values of menus.
pub const AXES_CHOICES: [(&str, Option<UserAxes>); 3] =
    [("", None), ("enh", Some(UserAxes::Enh)), ("neh", Some(UserAxes::Neh))];

pub fn xyz_cells(axes: ShownAxes, point: &Point, decimals: usize) -> impl IntoView + use<> {
    let xyz = point.xyz;
    axes.order().map(|k| view! { <td>{format::maybe(xyz.map(|x| x[k]), decimals)}</td> }).collect_view()
}

pub fn sigma_cells(axes: ShownAxes, point: &Point) -> impl IntoView + use<> {
    let sigma = point.sigma.unwrap_or_default();
    let role = point.role;
    axes.order()
        .map(|k| {
            let shown = match sigma[k] {
                Some(s) if s > 0.0 => format::fixed(s, format::decimals_for(s)),
                _ if role == Role::Tie => "–".to_owned(),
                _ => text::fixed().to_owned(),
            };
            view! { <td>{shown}</td> }
        })
        .collect_view()
}

#[component]
pub fn CoordinateHead(
    #[prop(optional)] unit: Option<String>,
    #[prop(optional)] axes: Option<ShownAxes>,
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    // The project's, or that of a list before it is taken.
    let unit = Memo::new(move |_| unit.clone().unwrap_or_else(|| desk.document.with(|d| d.project.unit.clone())));
    let axes = Memo::new(move |_| axes.unwrap_or_else(|| desk.axes()));
    let coordinate = move |name: &'static str| view! { <th>{name} " " <u>{unit}</u></th> };
    let sigma = move |name: &'static str| view! { <th>"σ"<sub>{name}</sub> " " <u>{unit}</u></th> };
    view! {
        <th class="left">{text::id}</th>
        <th class="left">{text::role}</th>
        {move || axes.get().names().map(coordinate).collect_view()}
        {move || axes.get().names().map(sigma).collect_view()}
        <td class="left wide"></td>
    }
}
