// Compute entry of lib/lists/list_depths.glsl.
#define LIST_IN_COMPUTE 1
#include "lib/lists/list_depths.glsl"

void main()
{
    findDepths(listItem());
}
