//! 서로 고정된 카메라.

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean mounted {
    rig: "서로 고정된 카메라";
    offer: "한 틀에 고정되어 동시에 촬영하는 카메라입니다. 사진들이 하나의 상대 자세를 공유하므로 망이 더 단단해집니다.";
    means: "한 행의 사진은 동시에 찍은 것입니다. 첫 카메라에 대한 각 카메라의 상대 자세를 하나로 추정하며, 이 표준오차만큼 흩어질 수 있습니다.";
    taken_together: "동시에 찍은 사진";
    remove: "카메라를 서로 독립으로";
    sigma_position: "상대 위치의 σ";
    sigma_rotation: "상대 회전의 σ";
    photo_of(row, column): "{row}번째 촬영의 카메라 {column} 사진";
    base(camera, first, base): "카메라 {camera}에서 {first}까지의 거리: {base}.";
    scatter(n, position, rotation): "{n}회 촬영이 공통 상대 자세에서 {position}, {rotation}만큼 흩어집니다.";
    outlier(first, own, position, rotation): "사진 {first}, {own}의 상대 자세가 {position}, {rotation}만큼 벗어나며 우연으로 볼 수 없습니다. 고정 틀이 움직였거나 동시에 찍은 사진이 아닙니다. 그 행을 고치거나 지우십시오.";
    one_exposure: "촬영이 한 번뿐이므로 비교할 것이 없습니다.";
    two_cameras: "동시에 찍은 사진에는 사진이 있는 카메라가 둘 이상 필요합니다. 카메라마다 사진을 따로 지정하십시오.";
    no_photo(name): "{name}{name:이라는|라는} 사진이 없습니다. 사진 이름을 입력하거나, 사진이 없으면 비워 두십시오.";
    other_camera(photo, camera): "사진 {photo}의 카메라는 이 열의 카메라 {camera}{camera:이|가} 아닙니다.";
    no_sigma(typed): "“{typed}”: 표준오차는 0보다 큰 수입니다. 이전 값을 유지합니다.";
    change_rig: "동시에 찍은 사진 지정";
} }
