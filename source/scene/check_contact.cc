#include <snug/scene/check.h>
#include <snug/scene/values.h>

#include <algorithm>

namespace snug
{
  namespace scene
  {
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
                            "'" + quotable(boundary) + "' is no boundary of '" +
                              name + "', they are " + listed(known) +
                              did_you_mean(boundary, known));
    }

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
  } // namespace scene
} // namespace snug
