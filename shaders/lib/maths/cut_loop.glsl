// NaN, of loops that Mesa ends after 65,535 iterations together: it shows, where light that is not known would not.
#pragma once

#define CUT_LOOP uintBitsToFloat(0x7FC00000u)
