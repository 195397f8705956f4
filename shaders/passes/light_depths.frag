// Fragment entry of lib/list_depths.glsl.
#define LIST_IN_COMPUTE 0
#include "lib/list_depths.glsl"

void main()
{
    findDepths(listItem());
}
