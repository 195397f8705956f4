// Compute entry of lib/lists/list_masks.glsl.
#define LIST_IN_COMPUTE 1
#include "lib/lists/list_masks.glsl"

void main()
{
    maskBin(listItem());
}
