#include <snug/mesh/formula.h>
#include <snug/scene/check.h>
#include <snug/scene/values.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <stdexcept>

namespace snug
{
  namespace scene
  {
    namespace
    {
      bool
      is_finite(const std::vector<double> &values)
      {
        return std::all_of(values.begin(), values.end(), [](const double v) {
          return std::isfinite(v);
        });
      }

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
          require_known(known, "Displacement", body.displacements);
          require_known(known, "Pressure", body.loads.pressure);
          require_known(known, "Traction", body.loads.traction);
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
                                    error.what() + component_names());
              }
        }

        void
        check_displacements() const
        {
          std::set<std::pair<std::string, unsigned int>> known;
          for (const auto &item : body.supports)
            for (const unsigned int c : component_list(item.second, dimension))
              known.emplace(item.first, c);
          for (const auto &item : body.displacements)
            {
              const auto [name, formula] = split_displacement(item.second);
              const auto number          = component_number(name, dimension);
              const auto value           = to_text(body.displacements);
              require(number.has_value(),
                      "Displacement",
                      value,
                      "'" + quotable(name) + "' is no component" +
                        component_names());
              require(!formula.empty(),
                      "Displacement",
                      value,
                      "'" + quotable(item.second) +
                        "' must read 'component = formula'");
              require(known.emplace(item.first, *number).second,
                      "Displacement",
                      value,
                      "'" + name + "' of '" + item.first +
                        "' is held twice or by 'Supports' as well");
              check_formula("Displacement", value, formula);
            }
        }

        void
        check_loads() const
        {
          const auto &loads = body.loads;
          for (const auto &item : loads.pressure)
            require(std::isfinite(item.second),
                    "Pressure",
                    to_text(loads.pressure),
                    "must be finite");
          for (const auto &item : loads.traction)
            require(is_finite(item.second) && item.second.size() == dimension,
                    "Traction",
                    to_text(loads.traction),
                    "the vector of '" + item.first + "' must have " +
                      to_text(dimension) + " components separated by blanks");
          if (!loads.body_force.empty())
            require_length(loads.body_force.size(),
                           "Body force",
                           loads.body_force);
          require(is_finite(loads.body_force),
                  "Body force",
                  to_text(loads.body_force),
                  "must be finite");
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

        template <typename T>
        void
        require_length(const std::size_t     n,
                       const std::string    &entry,
                       const std::vector<T> &values) const
        {
          require(n == dimension,
                  entry,
                  to_text(values),
                  "must have " + to_text(dimension) +
                    " numbers separated by commas, one per dimension");
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

        std::string
        component_names() const
        {
          return std::string("; components are ") +
                 (dimension == 2 ? "x, y" : "x, y, z") + " and normal";
        }

        /// @p formula, a part of the @p value of an entry, must be one.
        void
        check_formula(const std::string &entry,
                      const std::string &value,
                      const std::string &formula) const
        {
          try
            {
              if (dimension == 2)
                mesh::Formula<2>(entry, formula);
              else
                mesh::Formula<3>(entry, formula);
            }
          catch (const InputError &error)
            {
              const std::string message = error.what();
              throw origins.error(path(entry),
                                  value,
                                  "'" + quotable(formula) + "' " +
                                    message.substr(message.find("must be")));
            }
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
      std::vector<std::string> bodies, obstacles, shapes;
      for (const auto &body : scene.bodies)
        bodies.push_back(body.name);
      for (const auto &obstacle : scene.obstacles)
        obstacles.push_back(obstacle.name);
      for (const auto &shape : scene.shapes)
        if (!shape.name.empty() || scene.shapes.size() > 1)
          shapes.push_back(shape.name);
      if (bodies.empty())
        throw origins.error("Bodies", "", "must name at least one body");
      check_list_of_names("Bodies", bodies, origins);
      check_list_of_names("Obstacles", obstacles, origins);
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
          check.check_displacements();
          check.check_loads();
        }
    }
  } // namespace scene
} // namespace snug
