// Fragment entry of lib/list_count.glsl.
#define LIST_IN_COMPUTE 0
#include "lib/list_count.glsl"

void main()
{
    countTile(listItem());
}
