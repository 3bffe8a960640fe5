//! 인쇄할 표적의 문장.

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean printing {
    targets_to_print: "표적 인쇄";
    targets_to_print_words: "링 코드, 점, 축척 막대, 검정판을 실제 크기 그대로 PDF와 SVG로 만듭니다. 오프라인에서도 됩니다.";
    sheets_sentence(codes, dots, bars, sheets): "링 코드 {codes}개, 점 {dots}개, 축척 막대 {bars}쌍, 모두 {sheets}장.";
    nothing_yet: "아직 그린 것이 없습니다.";
    save_svg: "SVG 저장";
    save_pdf(sheets): "PDF {sheets}장 저장";
    save_lists: "지름과 거리 파일 저장";
    coded_targets: "코드 표적";
    family: "계열";
    schneider(bits): "Schneider / AICON, {bits}비트";
    metashape(bits): "Metashape 원형, {bits}비트";
    how_many: "개수";
    numbers: "또는 코드 번호";
    numbers_hint: "예: 1-20, 35";
    family_has(all): "이 계열에는 코드가 {all}개 있습니다.";
    family_at_distance(count, distance): "그중 {count}개는 어떻게 돌려도 {distance}구획 이상 다릅니다";
    printed_distance(distance, hidden):
        "이 종이들의 코드는 서로 {distance}구획 이상 다릅니다. {hidden}구획을 잘못 읽거나 가려도 다른 코드로 읽히지 않습니다.";
    dot_diameter: "점 지름";
    ground: "바탕";
    ground_paper: "흰 바탕에 검은 점";
    ground_retro: "검은 바탕에 흰 점 (반사지)";
    also_on_sheets: "함께 인쇄";
    plain_dots: "코드 없는 점";
    jittered: "점을 격자에서 무작위로 옮김";
    bar_pairs: "축척 막대 쌍";
    bar_length: "쌍의 거리";
    calibration_field: "검정판과 그 좌표";
    field_sheets: "가로 × 세로 장수";
    cut_marks: "재단선";
    small_print: "작은 글씨로 번호와 계열";
    paper: "용지";
    sheet_title: "종이에 적을 제목";
    sheets: "인쇄할 장";
    sheet_of(sheet, all): "{all}장 중 {sheet}";
    previous_sheet: "이전 장";
    next_sheet: "다음 장";
    preview: "인쇄 미리보기";
    ruler_of_print: "자 확인";
    one_is_enough: "한 장이면 됩니다";
    ruler_across: "가로 100 mm의 실측값";
    ruler_down: "세로 100 mm의 실측값";
    as_across: "가로와 같음";
    reading_sigma: "읽기 σ";
    not_measured: "한 장을 크기 맞춤 없이 100 %로 인쇄하고 자를 재십시오. 잰 값이 지름, 인쇄된 거리, 공칭좌표에 반영됩니다.";
    print_scale(across, down, sigma, diameter):
        "인쇄 축척 가로 {across}, 세로 {down}, ± {sigma}. 점 지름은 {diameter} mm입니다. 지름, 인쇄된 거리, 공칭좌표에 반영되며, 손으로 붙인 막대는 막대에서 잽니다.";
    which_diameter: "지름 선택";
    camera_words(c, width, height): "c {c} px, {width} × {height} px";
    camera_assumed: "프로젝트에 카메라가 없어 28 mm, 2400만 화소로 가정";
    col_distance: "거리";
    col_pixel: "화소";
    col_least: "최소";
    col_best: "권장";
    col_dot: "사진 속 점";
    straight_on: "0°";
    at_slant: "60°";
    advice_words: "점은 최소 8화소, 되도록 15화소로 찍혀야 합니다. 60°에서는 폭이 절반입니다.";
    too_small: "너무 작음";
    just_so: "60°에서 작음";
    print_hint: "\"용지에 맞춤\" 없이 인쇄하십시오. PDF 자체에도 그렇게 지정되어 있습니다.";
} }
