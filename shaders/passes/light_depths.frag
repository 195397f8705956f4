// Fragment entry of lib/lists/list_depths.glsl.
#define LIST_IN_COMPUTE 0
#include "lib/lists/list_depths.glsl"

void main()
{
    findDepths(listItem());
}
