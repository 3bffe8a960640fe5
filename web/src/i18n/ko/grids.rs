//! 원형 격자판: 점에 이름 붙이기.

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean grids {
    circle_grid: "원형 격자";
    how: "모든 사진에서 원형 검정판의 점에 이름을 붙입니다";
    name_dots: "점에 이름 붙이기";
    kind: "종류";
    symmetric: "대칭";
    asymmetric: "비대칭";
    rows: "행";
    columns: "한 행의 점 수";
    pitch: "행 간격";
    sigma: "점의 σ";
    diameter: "점 지름";
    hint: "비대칭 판에서 한 행의 점 간격은 행 간격의 두 배입니다. σ를 주면 점은 기준점이 되고(0은 고정), 비워 두면 판의 좌표를 초기값으로 하는 결합점이 됩니다.";
    first_how: "돌려도 같아 보이는 판이면 먼저 사진 한 매에서 첫 점을 선택하십시오.";
    first_is(target, photo): "판이 돌려도 같아 보이면 사진 {photo}의 표적 {target}{target:을|를} 첫 점으로 봅니다.";
    named_in(named, all, observations): "사진 {all}매 중 {named}매에서 이름을 붙였습니다. 새 관측 {observations}개.";
    assumed(n): "이 판은 돌려도 같아 보입니다. 사진 {n}매에서 행이 오른쪽으로 향한다고 가정했습니다. 모든 사진에서 카메라의 위아래가 같았다면 맞습니다. 아니면 실행을 취소하고 사진 한 매에서 첫 점을 선택한 뒤 다시 이름을 붙이십시오.";
    named_before(n): "점 {n}개는 이미 다른 이름이 있어 그대로 두었습니다.";
    prefixed(prefix): "다른 점이 이미 이 이름을 쓰므로 이름 앞에 {prefix}{prefix:을|를} 붙였습니다.";
    no_grid(targets): "표적 {targets}개에서 격자를 찾지 못했습니다. 판에서 이웃한 점이 적어도 3 × 3개 보여야 합니다.";
    not_this_board(dots): "점 {dots}개의 격자는 이 판의 일부가 아닙니다. 행, 열과 종류를 확인하십시오.";
    ambiguous(dots, places): "보이는 점 {dots}개가 판의 {places}곳에 맞습니다. 점이나 모서리가 더 많이 보이게 찍으십시오.";
    several_boards(count): "사진에서 격자 {count}개가 이 판일 수 있습니다. 다른 격자를 가리거나 판 하나만 찍으십시오.";
    other_dots(dots, others): "점 {dots}개의 격자가 사진에서 잘렸고, 같은 크기의 다른 점이 {others}개 있습니다. 판 전체가 보이게 찍거나 옆에 있는 것을 가리십시오.";
    mark(seen): "모서리 표시가 있을 수 있는 곳에 보이는 표적: {seen}개. 정확히 하나여야 합니다.";
    change_dots(n): "원형 격자의 점 {n}개에 이름 붙이기";
    no_count(typed): "“{typed}”: 2 이상의 정수가 아닙니다. 이전 값을 유지합니다.";
    no_length(typed): "“{typed}”: 0보다 큰 길이가 아닙니다. 이전 값을 유지합니다.";
    no_sigma(typed): "“{typed}”: 표준오차가 아닙니다(0 이상, 또는 비움). 이전 값을 유지합니다.";
    diameter_apart(seen, given): "간격으로 계산한 점 지름은 {seen}이고 판의 지름은 {given}입니다. 간격, 지름과 종류를 확인하십시오.";
} }
