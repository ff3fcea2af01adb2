#include <snug/geometry/boundary_formulas.h>
#include <snug/geometry/face_list.h>
#include <snug/scene/check.h>

#include <algorithm>

namespace snug::scene {
namespace {
/// Check that the bodies and boundaries named by the shape exist.
void check_places(const Scene                  &scene,
                  const SectionCheck           &section,
                  const shape::ShapeParameters &shape)
{
  if (shape.reads("Bodies"))
    for (const auto &body : shape.bodies)
      section.require(body_index(scene, body) < scene.bodies.size(), "Bodies",
                      to_text(shape.bodies), "there is no body '" + quotable(body) + "'");
  if (!shape.reads("Face"))
    return;
  const auto faces = geometry::face_list(shape.face);
  for (const auto &face : faces)
    {
      require_face(scene, section, "Face", shape.face, face);
      section.require(split_face(face).first == split_face(faces.front()).first, "Face", shape.face,
                      "must name boundaries of one body");
      section.require(std::count(faces.begin(), faces.end(), face) == 1, "Face", shape.face,
                      "'" + face + "' must be named once");
    }
  const auto &body = scene.bodies[body_index(scene, split_face(faces.front()).first)];
  for (const auto &boundary : shape.smooth)
    require_boundary(section, "Smooth across symmetry", to_text(shape.smooth), body, boundary);
  section.require(shape.interior != shape::InteriorKind::linear_blending || faces.size() == 1,
                  "Interior", to_text(shape.interior),
                  "must be auto, Laplace or elasticity for a face of several boundaries");
  section.require(shape.interior != shape::InteriorKind::linear_blending ||
                    body.mesh.source == geometry::Source::box,
                  "Interior", to_text(shape.interior),
                  "must be auto, Laplace or elasticity for the body '" + body.name +
                    "', which is not a box");
  section.require(shape.interior != shape::InteriorKind::linear_blending ||
                    !geometry::is_part(body.mesh, split_face(faces.front()).second),
                  "Interior", to_text(shape.interior),
                  "must be auto, Laplace or elasticity for the face '" + shape.face +
                    "', which 'Boundary formulas' make a part of a side");
}
} // namespace

void check_shapes(const Scene &scene, const Origins &origins)
{
  for (const auto &shape : scene.shapes)
    {
      const SectionCheck section(shape.section(), origins, scene.dimension);
      shape.check(section);
      check_places(scene, section, shape);
    }
  const bool moves = std::any_of(scene.shapes.begin(), scene.shapes.end(),
                                 [](const auto &shape) { return shape.moves(); });
  if (!moves && scene.task != Task::state)
    throw origins.error(scene.shapes.front().path("Basis"), "none",
                        "must not be none: Task = " + to_text(scene.task) +
                          " needs design variables");
}
} // namespace snug::scene
