// Nearest depth, and farthest depth negated, of what is drawn; the target keeps the larger of each.
layout(location = 0) out vec2 depths;

void main()
{
    depths = vec2(gl_FragCoord.z, -gl_FragCoord.z);
}
