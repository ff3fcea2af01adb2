#include <snug/geometry/face_list.h>
#include <snug/scene/check.h>

#include <algorithm>

namespace snug::scene {
namespace {
/// Give access to a number that may be missing, which is the text "none".
Access number_or_none(std::optional<double> &value)
{
  return {[&value]() { return value ? to_text(*value) : std::string("none"); },
          [&value](const std::string &text) {
            value.reset();
            if (text != "none")
              from_text(text, value.emplace());
          }};
}

/// Return the bodies of both sides of a pair, ascending.
std::pair<std::string, std::string> bodies_of(const std::pair<std::string, std::string> &sides)
{
  const auto body = [](const std::string &side) {
    return split_face(geometry::face_list(side).front()).first;
  };
  return std::minmax(body(sides.first), body(sides.second));
}
} // namespace

void Bolt::declare(Entries &entries)
{
  entries.add("Pair", pair, allowed("slave: master"),
              "The tied pair of 'Contact' that cuts the shank: 'head.cut: shank.cut'.");
  entries.add("Preload", number_or_none(preload), allowed("none or a number"),
              "The tension to which the bolt is tightened in all load cases but load steps. Units: "
              "force.");
  entries.add("Shortening", number_or_none(shortening), allowed("none or a number"),
              "The length by which the bolt is shortened in all load cases but load steps, instead "
              "of 'Preload'. Units: length.");
}

std::pair<std::string, std::string> Bolt::sides() const
{
  const auto colon = pair.find(':');
  return {trim(pair.substr(0, colon)),
          colon == std::string::npos ? "" : trim(pair.substr(colon + 1))};
}

Tightening tightening(const Scene &scene, const Bolt &bolt, const unsigned int load_case)
{
  if (scene.load_cases.empty())
    return {bolt.preload, bolt.shortening};
  const auto &of      = scene.load_cases[load_case];
  const auto  preload = of.preloads.find(bolt.name);
  const auto  shorten = of.shortenings.find(bolt.name);
  if (preload != of.preloads.end())
    return {preload->second, {}};
  if (shorten != of.shortenings.end())
    return {{}, shorten->second};
  if (of.load_step && load_case > 0)
    return {};
  return {bolt.preload, bolt.shortening};
}

namespace {
void check_bolt(const Scene &scene, const Origins &origins, const Bolt &bolt)
{
  const SectionCheck       own(bolt.section(), origins, scene.dimension);
  std::vector<std::string> tied;
  for (const auto &pair : scene.contact.pairs)
    if (pair.parameters.law == contact::Law::tied)
      tied.push_back(pair.slave + ": " + pair.master);
  const auto [a, b]  = bolt.sides();
  const auto is_pair = [a = a, b = b](const std::string &name) {
    return name == a + ": " + b || name == b + ": " + a;
  };
  own.require(std::any_of(tied.begin(), tied.end(), is_pair), "Pair", bolt.pair,
              "must be a pair of 'Contact' with Law = tied", suggestion(bolt.pair, tied));
  for (const auto &other : scene.bolts)
    own.require(&other == &bolt || !is_pair(other.pair), "Pair", bolt.pair,
                "is the pair of the bolt '" + other.name + "' too");
  for (const auto &pair : scene.contact.pairs)
    own.require(pair.parameters.law != contact::Law::tied ||
                  is_pair(pair.slave + ": " + pair.master) ||
                  bodies_of({pair.slave, pair.master}) != bodies_of({a, b}),
                "Pair", bolt.pair,
                "does not cut the bolt, because '" + pair.slave + ": " + pair.master +
                  "' ties the same bodies");
  own.require(!bolt.preload || !bolt.shortening, "Shortening",
              bolt.shortening ? to_text(*bolt.shortening) : "", "must be none with 'Preload'");
  for (unsigned int c = 0; c < std::max<std::size_t>(1, scene.load_cases.size()); ++c)
    {
      const auto state = tightening(scene, bolt, c);
      if (state.preload || state.shortening)
        continue;
      own.require(c > 0 && scene.load_cases[c].load_step, "Preload", "none",
                  scene.load_cases.empty()
                    ? "must be given, or 'Shortening'"
                    : "must be given, or 'Shortening', for load case '" + scene.load_cases[c].name +
                        "', which is no load step after another one");
    }
}
} // namespace

void check_bolts(const Scene &scene, const Origins &origins)
{
  const auto known = names_of(scene.bolts);
  for (const auto &bolt : scene.bolts)
    {
      check_bolt(scene, origins, bolt);
      const auto points = names_of(scene.points);
      if (std::find(points.begin(), points.end(), bolt.name) != points.end())
        throw origins.error("Bolts", to_text(known),
                            "'" + bolt.name + "' is the name of a reference point");
    }
  for (const auto &load_case : scene.load_cases)
    {
      const SectionCheck section(load_case.section(), origins, scene.dimension);
      for (const auto *list : {&load_case.preloads, &load_case.shortenings})
        for (const auto &[name, number] : *list)
          {
            const std::string entry = list == &load_case.preloads ? "Preload" : "Shortening";
            section.require(std::find(known.begin(), known.end(), name) != known.end(), entry,
                            to_text(*list), "there is no bolt '" + quotable(name) + "'",
                            suggestion(name, known));
            section.require(list == &load_case.preloads || load_case.preloads.count(name) == 0,
                            entry, to_text(*list), "'" + name + "' has a 'Preload' as well");
          }
    }
}
} // namespace snug::scene
