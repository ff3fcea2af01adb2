#include <snug/geometry/boundary_formulas.h>
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
  require_face(scene, section, "Face", shape.face, shape.face);
  const auto &body = scene.bodies[body_index(scene, split_face(shape.face).first)];
  section.require(shape.interior != shape::InteriorKind::linear_blending ||
                    body.mesh.source == geometry::Source::box,
                  "Interior", to_text(shape.interior),
                  "must be Laplace or elasticity for the body '" + body.name +
                    "', which is not a box");
  section.require(shape.interior != shape::InteriorKind::linear_blending ||
                    !geometry::is_part(body.mesh, split_face(shape.face).second),
                  "Interior", to_text(shape.interior),
                  "must be Laplace or elasticity for the face '" + shape.face +
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
