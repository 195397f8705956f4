// Entry point of lib/lists/list_scan.glsl.
#include "lib/lists/list_scan.glsl"

void main()
{
    scanTiles(listItem());
}
