//! 페이지 머리, 단축키, 열린 질문, 표의 문장.

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean general {
    // Shell
    start_page: "Sightline, 시작";
    no_project: "열린 프로젝트 없음";
    not_saved: "아직 저장 안 됨";
    steps: "단계";
    undo: "실행 취소";
    redo: "다시 실행";
    switch_language: "언어: 영어로 바꾸기";
    switch_theme: "화면 색: 바꾸기";
    theme_light: "밝게";
    theme_dark: "어둡게";
    theme_sun: "야외";
    more_actions: "더 보기";
    dismiss: "닫기";
    cancel: "취소";
    done_of(done, total): "{done} / {total}";
    version(version): "버전 {version}";
    units(unit): "{unit}, 도, 표준오차 1σ";
    in_photos(n): "사진 {n}매";
    worker_lost(detail): "계산이 중단되어 작업자를 다시 시작했습니다({detail}). 잃은 자료는 없습니다. 다시 시도하고, 메모리가 부족하면 사진 수나 크기를 줄이십시오.";

    // Keys
    keys_title: "단축키";
    keys_note: "글자를 입력하는 동안에는 단축키가 멈춥니다.";
    single_keys: "한 글자 단축키 사용";
    close: "닫기";
    keys_everywhere: "어디서나";
    keys_measuring: "측정";
    keys_in_photo: "사진에서";
    keys_in_tables: "표에서";
    key_escape: "선택이나 질문 취소";
    key_yes: "예: 질문한 표적을 받아들임";
    key_no: "아니요, 또는 이 점의 다음 사진";
    key_doubtful: "다음 의심점";
    key_exclude: "선택한 관측값 제외 또는 복원. 점 표에서도 됨";
    key_photos: "다음 사진, 이전 사진";
    key_arrows: "선택한 것을 1 px, Shift 10, Alt 0.1만큼 옮김. 없으면 십자선을 옮김";
    key_enter: "십자선 위치에서 측정";
    key_one_to_one: "1:1";
    key_zoom: "확대와 축소";
    key_pan: "누른 채 끌어 이동";
    key_cells: "셀 사이 이동";
    key_range: "범위 선택";
    key_all: "모두 선택";
    key_edit: "셀에 입력";

    // Open questions
    questions: "질문";
    question_of(n, all): "질문 {n} / {all}";
    is_this(point): "이 표적이 점 {point}입니까?";
    which_is_this: "이 표적은 어느 점입니까?";
    no: "아니요";
    other: "다른 점";
    next_question: "다음";
    answer_them: "답하기";
    no_questions: "열린 질문이 없습니다.";

    // Tables
    observations_table: "관측값";
    file: "파일";
    width: "너비";
    height: "높이";
    model: "모형";
    point_column: "점 이름";
    target_column: "표적";
    code: "코드";
    all_rows: "전체";
    few_rays: "광선 3 미만";
    large_w: "|w| 초과";
    marked_rows: "선택";
    rows_shown(shown, all): "{all}행 중 {shown}행 표시. Enter로 셀에 입력하고, Shift와 Control로 여러 행을 선택합니다.";
    filter_text: "이름으로 찾기";
    conditions: "표시할 행";
    rows_marked(n): "{n}행 선택";
    exclude: "제외";
    restore: "복원";
    rename_many: "이름 바꾸기…";
    merge: "합치기";
    split: "나누기";
    join_cameras: "카메라 합치기";
    fill_down: "아래로 채우기";
    delete_rows: "삭제";
    paste: "붙여넣기";
    pattern: "형식";
    pattern_start: "시작 번호";
    pattern_hint: "#은 번호 자리, *는 이전 이름입니다. P###이면 이름순으로 P001, P002가 됩니다.";
    nearest_tolerance: "최대 거리";
    rename_nearest(n): "주어진 {n}점 중 가장 가까운 점의 이름으로";
    nearest_hint: "주어진 좌표에서 가장 가까운 이름을 쓰려면 먼저 기준점·축척 단계에서 목록을 여십시오.";
    nearest_none: "주어진 점 가까이에 조정된 점이 없습니다.";
    paste_cells: "여기에 행을 붙여넣으십시오 (Ctrl+V)";
    plan_counts(good, bad, lost): "바꿀 셀 {good}개, 거부 {bad}개, 해당 행이 없는 줄 {lost}개";
    take_changes: "변경 적용";
    value_of_cell: "셀 값";
    refused_no_row: "그 행은 이제 없습니다.";
    refused_not_editable: "이 열은 고칠 수 없습니다.";
    refused_flag(typed): "\"{typed}\"{typed:은|는} 예나 아니요가 아닙니다. 1이나 0을 입력하십시오.";
    refused_role(typed): "\"{typed}\"{typed:은|는} 점 구분이 아닙니다. 결합점, 기준점, 검사점 중에서 입력하십시오.";
    refused_camera(typed): "카메라 \"{typed}\"{typed:이|가} 없습니다. 이 프로젝트의 카메라 이름을 입력하십시오.";
    cells_refused(n, why): "셀 {n}개를 바꾸지 못했습니다: {why}";
    nothing_to_delete: "삭제한 것이 없습니다. 사진이 있는 카메라는 삭제되지 않습니다.";
    merge_clash(photo): "사진 {photo}에 두 점이 함께 보이므로 한 점이 될 수 없습니다.";
    split_one_point: "한 점의 관측값만 선택하십시오. 선택한 관측값이 새 점이 됩니다.";
    split_leaves_nothing: "그 점의 관측값이 모두 선택되었습니다. 적어도 하나는 남기십시오.";
    name_twice(name): "두 점의 이름이 모두 {name}{name:이|가} 됩니다. 형식에 #을 넣으십시오.";
    cameras_differ: "사진 크기가 같은 카메라만 하나로 만들 수 있습니다.";
    change_cells(n, table): "셀 {n}개 편집, {table}";
    change_rows_excluded(n, table): "{n}행 제외, {table}";
    change_rows_restored(n, table): "{n}행 복원, {table}";
    change_rows_deleted(n, table): "{n}행 삭제, {table}";
    change_roles(n, role): "{n}점의 구분을 {role}{role:으로|로}";
    change_merged(n, into): "{n}점을 {into}{into:으로|로} 합침";
    change_split(point, new): "점 {point}에서 점 {new}{new:을|를} 나눔";
    change_points_renamed(n): "{n}점의 이름 변경";
    change_cameras_joined(n, into): "카메라 {n}대를 {into}{into:으로|로} 합침";
    change_question(photo): "사진 {photo}의 질문에 답함";
} }
