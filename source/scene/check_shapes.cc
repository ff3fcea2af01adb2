#include <snug/scene/check.h>
#include <snug/scene/values.h>

#include <algorithm>
#include <cmath>

namespace snug
{
  namespace scene
  {
    namespace
    {
      /// Checks the entries of one shape, as far as no mesh is needed.
      class ShapeCheck
      {
      public:
        ShapeCheck(const Scene                  &scene,
                   const shape::ShapeParameters &shape,
                   const Origins                &origins)
          : scene(scene), shape(shape), origins(origins)
        {
        }

        void
        check() const
        {
          if (shape.basis == "none")
            return;
          require_face(
            scene, origins, shape.path("Face"), shape.face, shape.face);
          check_control_points();
          check_direction();
          check_design();
        }

      private:
        void
        require(const bool         good,
                const std::string &entry,
                const std::string &value,
                const std::string &allowed) const
        {
          if (!good)
            throw origins.error(shape.path(entry), value, allowed);
        }

        void
        check_control_points() const
        {
          const auto        &points = shape.control_points;
          const unsigned int edges  = scene.dimension - 1;
          require(points.size() == edges,
                  "Control points",
                  to_text(points),
                  "must have " + to_text(edges) +
                    (edges == 1 ? " number" : " numbers separated by commas") +
                    ", one per edge of the face");
          // Bernstein polynomials of higher degree lose all digits.
          for (const unsigned int n : points)
            require(n >= 1 && n <= 50,
                    "Control points",
                    to_text(points),
                    "must lie between 1 and 50 each");
        }

        void
        check_direction() const
        {
          double square = 0.;
          for (const double component : shape.direction)
            square += component * component;
          require(shape.direction.size() == scene.dimension && square > 0. &&
                    std::isfinite(square),
                  "Direction",
                  to_text(shape.direction),
                  "must be " + to_text(scene.dimension) +
                    " numbers separated by commas, not all zero");
        }

        void
        check_design() const
        {
          const auto &bounds = shape.bounds;
          require(bounds.size() == 2 && std::isfinite(bounds[0]) &&
                    std::isfinite(bounds[1]) && bounds[0] < bounds[1],
                  "Bounds",
                  to_text(bounds),
                  "must be two numbers separated by a comma, the first below "
                  "the second");
          for (const double move : shape.initial)
            require(move >= bounds[0] && move <= bounds[1],
                    "Initial",
                    to_text(shape.initial),
                    to_text(move) + " must lie within the bounds " +
                      to_text(bounds));
        }

        const Scene                  &scene;
        const shape::ShapeParameters &shape;
        const Origins                &origins;
      };
    } // namespace

    void
    check_shapes(const Scene &scene, const Origins &origins)
    {
      bool none = true;
      for (const auto &shape : scene.shapes)
        {
          ShapeCheck(scene, shape, origins).check();
          none = none && shape.basis == "none";
        }
      if (none && scene.task != Task::state)
        throw origins.error(scene.shapes.front().path("Basis"),
                            "none",
                            "must not be none for the task " +
                              to_text(scene.task));
    }
  } // namespace scene
} // namespace snug
