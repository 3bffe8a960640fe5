//! 기준점과 거리, 그 목록의 문장.

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean control {
    // Control and scale
    control_and_scale: "기준점·축척";
    control_sentence(control, check, distances): "기준점 {control}개, 검사점 {check}개, 거리 {distances}개.";
    open_control: "기준점 파일 열기…";
    control_points: "기준점";
    paste_control(axes, sigmas): "행을 붙여 넣으십시오: 점 이름, {axes}, {sigmas}";
    pasted: "기준점, 붙여넣기";
    rows_read(all, bad): "{all}행 중 {bad}행 해석 불가";
    take_points(n): "점 {n}개 가져오기";
    measured: "측정됨";
    not_measured: "어느 사진에서도 측정되지 않음";
    fixed: "고정";
    distances: "거리";
    distance_same_point: "거리에는 서로 다른 두 점이 필요합니다.";
    distance_no_point: "양 끝점은 이 프로젝트의 점이어야 합니다.";
    distance_length: "길이를 양수로 입력하십시오. 예: 1250.4";
    distance_sigma: "이 길이의 표준오차를 양수로 입력하십시오. 예: 0.02";
    add_distance: "추가";
    remove_distance: "거리 삭제";
    from_point: "시점";
    to_point: "종점";
    length: "길이";
    unit_of_length: "길이 단위";
    unit_of_these: "단위";
    choose_unit: "고르기…";
    which_unit: "이 좌표의 단위를 고르십시오. 단위가 틀리면 축척이 예컨대 1000배 달라집니다.";
    unit_question(from, to, after):
        "수의 단위는 {from}입니다. {to}{to:으로|로} 환산하겠습니까(1000 {from} → {after} {to}), 아니면 처음부터 {to}였습니까?";
    unit_convert: "수를 환산";
    unit_relabel: "단위만 틀렸음";
    unit_unknown(unit): "\"{unit}\"{unit:은|는} 알려진 길이 단위가 아닙니다. 수의 단위를 고르십시오.";
    unit_unknown_question(from, to): "\"{from}\"{from:은|는} 알려진 단위가 아니어서 환산할 수 없습니다. 수의 단위가 {to}입니까?";
    unit_is_right: "예, 단위를 바꿈";
    read_separator(separator): "필드 구분: {separator}.";
    separator_comma: "쉼표";
    separator_semicolon: "세미콜론";
    separator_tab: "탭";
    separator_blanks: "빈칸";
    read_point: "소수점은 점.";
    read_comma: "소수점은 쉼표.";
    read_columns(columns): "머리글에 따른 열: {columns}.";
    read_columns_assumed(columns): "머리글이 없어 가정한 열: {columns}.";
    read_ignored(columns): "쓰지 않는 열: {columns}.";
    read_remarks(headings): "머리글에서 해석하지 못한 것: {headings}.";
    ask_decimal: "어느 수입니까?";
    ask_axes: "축을 알려 주는 머리글이 없습니다. 어느 좌표가 먼저입니까?";
    axes_xy: "X(동)";
    axes_yx: "Y(북)";
    in_unit(unit): "단위 {unit}";
    observed_centres: "관측된 투영중심";
    observed_centres_hint: "GNSS 등. 기준점 기준계에서 사용";
    forget_centre: "이 투영중심의 관측 해제";
    observe: "관측값으로 추가";
    datum: "기준계";
    datum_control: "기준점";
    datum_control_means: "결과가 기준점 좌표계에 놓이며, 기준점 오차가 형상을 변형시킵니다.";
    datum_minimal: "최소구속";
    datum_minimal_means: "좌표 7개만 고정합니다. 형상은 왜곡되지 않으나 표준오차는 선택한 7개에 따라 달라집니다.";
    datum_free: "자유망";
    datum_free_means: "전체 점의 내부구속으로 평균 표준오차가 가장 작고, 기준점은 초기값으로만 씁니다.";
} }
