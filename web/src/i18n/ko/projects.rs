//! 시작 화면, 프로젝트, 이 브라우저에 저장된 것의 문장.

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean projects {
    // Start
    formats: "JPEG, HEIC, RAW, PNG, TIFF, BMP, 8·16비트. RAW는 센서 값에서 직접 측정합니다.";
    choose_photos: "사진 고르기…";

    // Project
    project_name: "프로젝트 이름";
    saved_at(clock): "{clock} 저장됨";
    saved_without_photos(clock, n): "{clock} 저장됨, 사진 {n}매 제외";
    changed_after(clock): "{clock} 이후 변경됨";
    save: "프로젝트 파일 내려받기";
    save_all: "사진과 함께 내려받기";
    save_hint: "사진 없이 프로젝트 파일 내려받기";
    save_all_hint: "사진을 포함하여 프로젝트 파일 내려받기. 사진은 카메라가 기록한 그대로이며 촬영 위치(GPS)가 기록되어 있으면 함께 저장됨";
    photos_carry_places: "파일의 사진은 카메라가 기록한 그대로이며, 촬영 위치(GPS)가 기록되어 있으면 함께 들어 있습니다.";
    save_with_photos: "사진과 함께 프로젝트 파일 내려받기";
    saving: "저장 중";
    cannot_save(detail): "파일을 저장하지 못했습니다: {detail}";
    open_project: "프로젝트 열기…";
    opening_project: "프로젝트 여는 중";
    open_sample: "예제 프로젝트 열기";
    sample_words: "코드 표적과 일반 표적이 있는 패널의 컴퓨터 생성 사진. 한 번 눌러 조정된 상태로 엽니다.";
    sample_name: "예제";
    opening_sample: "예제 촬영·측정·조정 중";
    busy: "진행 중인 작업이 끝날 때까지 기다리거나 먼저 취소하십시오.";
    waits_at_identities(file): "{file}: 영상 측정값 파일입니다. 점 이름 단계에서 가져오십시오.";
    waits_at_control(file): "{file}: 기준점 파일입니다. 기준점·축척 단계에서 가져오십시오.";
    marks_or_control(file): "{file}{file:은|는} 영상 측정값(사진, 점, u, v)으로도 기준점(점 이름, X, Y, Z)으로도 읽을 수 있습니다. 어느 쪽입니까?";
    is_empty: "빈 파일입니다";
    file_empty(file): "{file}: 빈 파일입니다.";
    is_no_list: "영상 측정값(사진, 점, u, v), 기준점(점 이름, X, Y, Z), 알려진 점 사이의 거리(시점, 종점, 길이) 가운데 어느 것도 들어 있지 않습니다";
    unsaved_here: "저장하지 않은 변경이 있습니다.";
    unsaved_in(name): "{name}에 저장하지 않은 변경이 있습니다.";
    save_first: "사진과 함께 내려받은 뒤 열기";
    go_on_unsaved: "저장하지 않고 열기";
    undo_this(what): "실행 취소: {what}";
    redo_this(what): "다시 실행: {what}";
    out_of_date: "갱신 필요";
    n_iterations(n): "{n}회";
    photos_and_targets(done, total, targets): "사진 {done}/{total} · 표적 {targets}개";
    iteration_of(done, total): "반복 {done} / 최대 {total}";
    copy: "복사";
    show: "보기";
    discard: "버리기";
    found_by_orientation: "미상: 자동 추정";
    not_zero_or_more(typed): "\"{typed}\"{typed:은|는} 0 이상의 수가 아닙니다. 0.1과 같이 화소 수를 입력하십시오.";
    not_a_number(typed): "\"{typed}\"{typed:은|는} 수가 아닙니다. -0.0034와 같이 입력하십시오.";
    ambiguous_number(typed, decimal, thousands):
        "\"{typed}\"{typed:은|는} 두 가지로 읽힙니다. 쉼표가 소수점이면 {decimal}, 천 단위 구분이면 {thousands}입니다. 둘 가운데 하나로 입력하십시오.";
    ambiguous_short: "세 자리 앞의 쉼표는 두 가지로 읽힙니다. 1.234 또는 1234와 같이 입력하십시오.";

    // What this browser keeps
    recent_projects: "최근 프로젝트";
    on_this_computer: "이 컴퓨터에 보관";
    project: "프로젝트";
    column_photos: "사진";
    column_points: "점";
    column_changed: "변경";
    open_now: "열려 있음";
    without_name: "이름 없는 프로젝트";
    go_on: "열기";
    go_on_with(name): "열기: {name}";
    more_with(name): "더 보기: {name}";
    rename_project: "이름 바꾸기";
    duplicate: "복제";
    download: "사진과 함께 내려받기";
    delete_project: "삭제";
    copy_of(name): "{name} (사본)";
    deleted(name): "{name}{name:을|를} 삭제했습니다.";
    writing: "저장 중…";
    not_written: "저장 안 됨: 아래 참고";
    following: "다른 창에서 열림, 읽기만";
    copying_photos(n): "사진 복사 중, {n}매 남음";
    open_elsewhere: "이 프로젝트는 다른 창에서 열려 있습니다. 그 창의 작업이 여기에 보입니다. 여기서 작업하려면 넘겨받으십시오.";
    take_over: "넘겨받기";
    reads_along: "이 창은 읽기만 합니다. 고치려면 프로젝트를 넘겨받으십시오.";
    other_is_kept(name): "{name}{name:은|는} 이 컴퓨터에 보관되어 있으며 시작 화면에 있습니다.";
    held_elsewhere: "프로젝트가 다른 창에서 열려 있습니다. 그 창에서 하거나 그 창을 먼저 닫으십시오.";
    kept_as_copy(name, copy): "여기의 마지막 변경이 저장되기 전에 다른 창에서 {name}{name:을|를} 넘겨받았습니다. 변경은 별도의 프로젝트 {copy}에 보관했습니다.";
    storage_ended: "이 브라우저의 저장소를 다시 시작할 수 없음";
    list_unreadable(detail): "프로젝트 목록을 읽지 못했습니다({detail}). 프로젝트는 그대로 보관되어 있습니다. 페이지를 새로 고치거나 다른 창을 닫으십시오.";
    unreadable_project: "읽을 수 없는 프로젝트";
    journal_mended: "보관된 이 프로젝트에서 비트 하나가 바뀌어 있었습니다. 복구했으며 잃은 것은 없습니다. 손상된 파일은 시작 화면에서 내려받을 수 있습니다.";
    journal_damaged(n): "보관된 이 프로젝트가 손상되었습니다. 읽을 수 있는 가장 최근 상태를 열었습니다. 그 뒤의 상태 {n}개와 실행 취소 기록은 잃었습니다. 손상된 파일은 시작 화면에서 내려받을 수 있습니다.";
    journal_end_damaged: "보관된 이 프로젝트의 끝이 손상되어 마지막 변경을 잃었습니다. 손상된 파일은 시작 화면에서 내려받을 수 있습니다.";
    journal_to_be_opened: "보관된 이 프로젝트가 손상되었습니다. 먼저 여십시오. 읽을 수 있는 내용이 새로 보관됩니다.";
    download_damaged: "손상된 파일 내려받기";
    wipe: "이 페이지가 보관한 모든 것 삭제…";
    licences: "이 페이지에 포함된 소프트웨어의 라이선스";
    wipe_question: "이 브라우저에서 모든 프로젝트와 사진, 장비, 설정, 오프라인 사본을 삭제하시겠습니까? 되돌릴 수 없습니다.";
    wipe_now: "모두 삭제";
    gone_for_good: "이 프로젝트는 이 브라우저에 더 이상 보관되어 있지 않습니다.";
    deleted_projects: "삭제한 프로젝트";
    deleted_for_a_day: "하루 동안 보관";
    put_back: "되돌리기";
    keeps_nothing: "이 브라우저는 아무것도 보관하지 않습니다. 페이지를 닫기 전에 프로젝트 파일을 내려받으십시오.";
    storage_full: "이 컴퓨터의 저장 공간이 가득 찼습니다. 마지막 변경은 이 페이지에만 있습니다. 프로젝트 파일을 내려받거나 필요 없는 프로젝트를 삭제하십시오.";
    not_kept(detail): "마지막 변경을 보관하지 못해 이 페이지에만 있습니다({detail}). 프로젝트 파일을 내려받으십시오.";
    photos_not_copied(n, detail):
        "사진 {n}매를 브라우저 저장소에 복사하지 못했습니다({detail}). 사진과 함께 내려받아 두지 않으면 프로젝트를 다시 열 때 사진이 필요합니다.";
    no_room: "공간 부족";
    kept_unreadable(detail): "보관된 내용을 읽지 못했습니다({detail}). 삭제된 것은 없습니다. 손상된 경우 시작 화면에서 손상된 파일을 내려받을 수 있습니다.";
    kept_by_newer(version): "더 새로운 Sightline에서 보관한 프로젝트입니다(형식 {version}). 페이지를 새로 고쳐 그 버전을 받으십시오.";
    storage_cleared(n): "브라우저가 저장소를 비웠습니다. 프로젝트 {n}개가 목록에서 사라졌습니다. 내려받은 파일에서 여십시오.";
    cleared_under_page: "페이지가 열려 있는 동안 브라우저가 저장소를 비웠습니다. 이 프로젝트는 사진까지 지금 상태로 다시 보관했으며, 다른 프로젝트는 사라졌습니다. 저장소는 다시 비워질 수 있으니 프로젝트 파일도 내려받으십시오.";
    cleared_with_photos(n): "페이지가 열려 있는 동안 브라우저가 저장소를 비웠습니다. 이 프로젝트는 다시 보관했습니다. 사라진 사진 {n}매는 다시 끌어다 놓으십시오. 저장소는 다시 비워질 수 있으니 프로젝트 파일도 내려받으십시오.";
    held_by_windows: "브라우저가 저장소를 비웠지만 다른 창이 아직 그 파일을 열어 두고 있습니다. 다른 창을 닫으십시오. 그때까지 프로젝트는 이 페이지에만 있으니 프로젝트 파일을 내려받으십시오.";
    space_used(used, all): "{all} 중 {used} 사용";
    lasts: "공간이 부족해도 보관됨";
    may_be_cleared: "공간이 부족하면 브라우저가 비울 수 있음";
    part_did_not_come: "페이지의 이 부분을 불러오지 못했습니다. 네트워크 연결을 확인하십시오.";
    try_again: "다시 시도";
    no_network: "네트워크 없음. 이 페이지의 모든 기능은 그대로 작동합니다.";
    no_network_nor_copy: "네트워크 없음. 열려 있는 것은 작동하지만, 네트워크가 돌아올 때까지 페이지를 다시 열 수 없습니다.";
    needs_network: "페이지를 열려면 네트워크 필요";
    another_build: "서버에 다른 버전의 Sightline이 올라와 이 버전의 나머지를 받을 수 없습니다. 페이지를 새로 고치십시오. 프로젝트는 그대로 남습니다.";
    reload_page: "새로 고침";
    not_on_clipboard: "브라우저가 클립보드 복사를 허용하지 않았습니다. 셀을 선택해 키보드로 복사하거나 표를 내보내십시오.";
    update_ready: "Sightline의 새 버전이 준비되었습니다. 프로젝트는 그대로 남습니다.";
    take_update: "새 버전으로 다시 읽기";
} }
