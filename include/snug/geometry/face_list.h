#ifndef snug_geometry_face_list_h
#define snug_geometry_face_list_h

#include <string>
#include <vector>

namespace snug::geometry {
/// Return the parts of "body.boundary + body.boundary + ..".
std::vector<std::string> face_list(const std::string &faces);
} // namespace snug::geometry

#endif
