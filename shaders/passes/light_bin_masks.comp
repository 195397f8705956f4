// Compute entry of lib/list_masks.glsl.
#define LIST_IN_COMPUTE 1
#include "lib/list_masks.glsl"

void main()
{
    maskBin(listItem());
}
