#pragma once
#include "scenes/CheckElement.h"

namespace tessera::scenes {

/// Checks a light, its animation and its keyframes, as a part of checkScene(). Throws InputError that names the
/// element.
void checkLight(const CheckedElement& element, const Light& light);

} // namespace tessera::scenes
