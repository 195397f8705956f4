#pragma once
#include "scenes/CheckElement.h"

namespace tessera::scenes {

/// The part of checkScene() that concerns a light, its animation and its keyframes. Throws InputError that names the
/// element.
void checkLight(const CheckedElement& element, const Light& light);

} // namespace tessera::scenes
