#include <snug/scene/check.h>
#include <snug/scene/values.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

namespace snug
{
  namespace scene
  {
    namespace
    {
      /// Checks the entries of one body.
      class BodyCheck
      {
      public:
        BodyCheck(const Scene &scene, const Body &body, const Origins &origins)
          : dimension(scene.dimension)
          , model(scene.model)
          , body(body)
          , origins(origins)
        {
        }

        void
        check_material() const
        {
          const double E  = body.material.youngs_modulus;
          const double nu = body.material.poissons_ratio;
          require(std::isfinite(E) && E > 0.,
                  "Young's modulus",
                  to_text(E),
                  "must be positive");
          require(nu > -1. && nu < 0.5,
                  "Poisson's ratio",
                  to_text(nu),
                  "must be above -1 and below 0.5");
          const double density = body.material.density;
          require(std::isfinite(density) && density >= 0.,
                  "Density",
                  to_text(density),
                  "must not be negative");
          require(model != "plane stress" || body.formulation == "standard",
                  "Formulation",
                  body.formulation,
                  "must be standard for Model = plane stress, which does not "
                  "lock");
        }

        void
        check_boundaries() const
        {
          const auto known = boundary_names(body, dimension);
          require_known(known, "Supports", body.supports);
        }

        void
        check_supports() const
        {
          for (const auto &item : body.supports)
            try
              {
                require(!component_list(item.second, dimension).empty(),
                        "Supports",
                        to_text(body.supports),
                        "'" + item.first + "' must hold some components");
              }
            catch (const std::invalid_argument &error)
              {
                throw origins.error(path("Supports"),
                                    to_text(body.supports),
                                    error.what() + std::string("; ") +
                                      component_names(dimension));
              }
        }

      private:
        std::string
        path(const std::string &entry) const
        {
          return "Body " + body.name + "/" + entry;
        }

        void
        require(const bool         good,
                const std::string &entry,
                const std::string &value,
                const std::string &allowed) const
        {
          if (!good)
            throw origins.error(path(entry), value, allowed);
        }

        template <typename Map>
        void
        require_known(const std::vector<std::string> &known,
                      const std::string              &entry,
                      const Map                      &map) const
        {
          for (const auto &item : map)
            require(std::find(known.begin(), known.end(), item.first) !=
                      known.end(),
                    entry,
                    to_text(map),
                    "'" + quotable(item.first) + "' is no boundary of '" +
                      body.name + "', they are " + listed(known) +
                      did_you_mean(item.first, known));
        }

        unsigned int       dimension;
        const std::string &model;
        const Body        &body;
        const Origins     &origins;
      };

      bool
      is_good_name(const std::string &name)
      {
        return !name.empty() &&
               std::all_of(name.begin(), name.end(), [](const unsigned char c) {
                 return std::isalnum(c) || c == '_' || c == '-' || c == ' ';
               });
      }

      void
      check_list_of_names(const std::string              &entry,
                          const std::vector<std::string> &names,
                          const Origins                  &origins)
      {
        for (const auto &name : names)
          {
            if (!is_good_name(name))
              throw origins.error(entry,
                                  listed(names),
                                  "names must be made of letters, digits, "
                                  "'_', '-' and blanks");
            if (std::count(names.begin(), names.end(), name) > 1)
              throw origins.error(entry,
                                  listed(names),
                                  "'" + name + "' must not occur twice");
          }
      }
    } // namespace

    void
    check_names(const Scene &scene, const Origins &origins)
    {
      std::vector<std::string> bodies, load_cases, obstacles, responses, shapes;
      for (const auto &body : scene.bodies)
        bodies.push_back(body.name);
      for (const auto &load_case : scene.load_cases)
        load_cases.push_back(load_case.name);
      for (const auto &obstacle : scene.obstacles)
        obstacles.push_back(obstacle.name);
      for (const auto &shape : scene.shapes)
        if (!shape.name.empty() || scene.shapes.size() > 1)
          shapes.push_back(shape.name);
      for (const auto &response : scene.responses)
        responses.push_back(response.name);
      if (bodies.empty())
        throw origins.error("Bodies", "", "must name at least one body");
      check_list_of_names("Bodies", bodies, origins);
      check_list_of_names("Load cases", load_cases, origins);
      check_list_of_names("Obstacles", obstacles, origins);
      check_list_of_names("Responses", responses, origins);
      check_list_of_names("Shapes", shapes, origins);
    }

    void
    check_bodies(const Scene &scene, const Origins &origins)
    {
      for (const auto &body : scene.bodies)
        {
          check_mesh(scene, body, origins);
          const BodyCheck check(scene, body, origins);
          check.check_material();
          check.check_boundaries();
          check.check_supports();
        }
    }
  } // namespace scene
} // namespace snug
