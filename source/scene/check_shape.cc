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
      /// @p face must be "body.boundary" of the scene; it is (a part of) the
      /// @p value of the entry @p path.
      void
      require_face(const Scene       &scene,
                   const Origins     &origins,
                   const std::string &path,
                   const std::string &value,
                   const std::string &face)
      {
        const auto [name, boundary] = split_face(face);
        const unsigned int index    = body_index(scene, name);
        if (boundary.empty())
          throw origins.error(
            path, value, "'" + quotable(face) + "' must read 'body.boundary'");
        std::vector<std::string> known;
        if (index == scene.bodies.size())
          {
            for (const auto &body : scene.bodies)
              known.push_back(body.name);
            throw origins.error(path,
                                value,
                                "there is no body '" + quotable(name) +
                                  "', there are " + listed(known) +
                                  did_you_mean(name, known));
          }
        known = boundary_names(scene.bodies[index], scene.dimension);
        if (std::find(known.begin(), known.end(), boundary) == known.end())
          throw origins.error(path,
                              value,
                              "'" + quotable(boundary) +
                                "' is no boundary of '" + name +
                                "', they are " + listed(known) +
                                did_you_mean(boundary, known));
      }

      void
      check_control_points(const Scene &scene, const Origins &origins)
      {
        const auto        &points = scene.shape.control_points;
        const unsigned int edges  = scene.dimension - 1;
        if (points.size() != edges)
          throw origins.error("Shape/Control points",
                              to_text(points),
                              "must have " + to_text(edges) +
                                (edges == 1 ? " number"
                                            : " numbers separated by commas") +
                                ", one per edge of the face");
        // Bernstein polynomials of higher degree lose all digits.
        for (const unsigned int n : points)
          if (n < 1 || n > 50)
            throw origins.error("Shape/Control points",
                                to_text(points),
                                "must lie between 1 and 50 each");
      }

      void
      check_direction(const Scene &scene, const Origins &origins)
      {
        const auto &direction = scene.shape.direction;
        double      square    = 0.;
        for (const double component : direction)
          square += component * component;
        if (direction.size() != scene.dimension ||
            !(square > 0. && std::isfinite(square)))
          throw origins.error("Shape/Direction",
                              to_text(direction),
                              "must be " + to_text(scene.dimension) +
                                " numbers separated by commas, not all zero");
      }

      void
      check_design(const Scene &scene, const Origins &origins)
      {
        const auto        &bounds  = scene.shape.bounds;
        const auto        &initial = scene.shape.initial;
        const unsigned int n       = n_design_variables(scene.shape);
        if (bounds.size() != 2 || !std::isfinite(bounds[0]) ||
            !std::isfinite(bounds[1]) || !(bounds[0] < bounds[1]))
          throw origins.error("Shape/Bounds",
                              to_text(bounds),
                              "must be two numbers separated by a comma, the "
                              "first below the second");
        if (!initial.empty() && initial.size() != n)
          throw origins.error("Shape/Initial",
                              to_text(initial),
                              "must have 1 number or " + to_text(n) +
                                " numbers separated by commas, one per "
                                "control point");
        for (const double move : initial)
          if (!(move >= bounds[0] && move <= bounds[1]))
            throw origins.error("Shape/Initial",
                                to_text(initial),
                                to_text(move) + " must lie within the bounds " +
                                  to_text(bounds));
      }
    } // namespace

    void
    check_contact(const Scene &scene, const Origins &origins)
    {
      const std::string path  = "Contact/Pairs";
      const auto       &pairs = scene.contact.pairs;
      const std::string value = to_text(pairs);
      for (auto pair = pairs.begin(); pair != pairs.end(); ++pair)
        {
          require_face(scene, origins, path, value, pair->first);
          require_face(scene, origins, path, value, pair->second);
          if (pair->first == pair->second)
            throw origins.error(path,
                                value,
                                "'" + pair->first +
                                  "' must not be paired with itself");
          const std::pair<std::string, std::string> swapped(pair->second,
                                                            pair->first);
          if (std::count(pairs.begin(), pair, *pair) > 0 ||
              std::count(pairs.begin(), pair, swapped) > 0)
            throw origins.error(path,
                                value,
                                "'" + pair->first + "' and '" + pair->second +
                                  "' must not be paired twice");
        }
    }

    void
    check_shape(const Scene &scene, const Origins &origins)
    {
      const auto &shape = scene.shape;
      if (shape.basis == "none")
        {
          if (scene.task != Task::state)
            throw origins.error("Shape/Basis",
                                shape.basis,
                                "must not be none for the task " +
                                  to_text(scene.task));
          return;
        }
      require_face(scene, origins, "Shape/Face", shape.face, shape.face);
      check_control_points(scene, origins);
      check_direction(scene, origins);
      check_design(scene, origins);
    }
  } // namespace scene
} // namespace snug
