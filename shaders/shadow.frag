// Writes only depth.
#version 460
void main() {}
