'use strict';
// What the reader has made so far: samples, an isovalue, sites, and surface points inserted by hand. All
// else follows from these and is found anew when it is asked for.

const kLetters = 'ABCDEFGHJLMNPQRSUVWXYZ';

class State {
  constructor(header) {
    this.header = header;
    this.limit = 0.1;
    this.start_again();
  }

  start_again() {
    const { header } = this;
    this.field = new Field({ ...header, samples: [...header.samples] });
    this.kappa = header.isovalue;
    this.chosen_sample = header.chosen;
    this.contour = contour_of(this.field, this.kappa);
    this.sites = [];
    header.sites.forEach((place) => this.add_site(nearest_vertex(this.contour, place)));
    this.chosen = 0;
  }
  changed() {
    this.regions = regions_of(this.contour, this.sites);
    this.fault = certificate_of(this.contour, this.sites, this.regions);
    // Stage 2 begins with a K that is right: where the certificate fails, that of a copy of the sites,
    // with those that it asks for.
    this.added = certify(this.contour, this.sites).slice(this.sites.length);
    this.loops = this.walks([...this.sites, ...this.added]);
    this.edge = null;  // a place on the edge that the picture of insertion is about; none: the worst
    this.by_hand = 0;
    this.said = '';
  }
  // T's loops from site to site. They are K where the certificate holds; else they meet themselves.
  walks(sites) {
    return dual_loops(this.contour, regions_of(this.contour, sites))
      .map((loop) => loop.map((n) => this.contour.points[sites[n]]));
  }
  // Sites go to the vertices of another T that are nearest.
  recontour() {
    const places = this.sites.map((v) => this.contour.points[v]);
    this.contour = contour_of(this.field, this.kappa);
    this.sites = [];
    for (const place of places) {
      const v = nearest_vertex(this.contour, place, (u) => !this.sites.includes(u));
      if (v >= 0) this.sites.push(v);
    }
    this.chosen = Math.min(this.chosen, this.sites.length - 1);
    this.changed();
  }
  set_kappa(kappa) {
    this.kappa = kappa;
    this.recontour();
  }
  choose_sample(i, j) { this.chosen_sample = [i, j]; }
  // Samples at the sides of the slice stay, so that no loop is cut; and some of the surface stays.
  can_change(i, j) { return i > 0 && j > 0 && i < this.field.columns - 1 && j < this.field.rows - 1; }
  set_sample(value) {
    const [i, j] = this.chosen_sample, before = this.field.at(i, j);
    if (!this.can_change(i, j) || value === before) return;
    this.field.set(i, j, value);
    if (contour_of(this.field, this.kappa).points.length < 12) this.field.set(i, j, before);
    this.recontour();
  }
  add_site(v) {
    if (v < 0 || this.sites.includes(v)) return;
    this.sites.push(v);
    this.chosen = this.sites.length - 1;
    this.changed();
  }
  // At the vertex of T that is furthest from its site.
  add_furthest_site() {
    const far = this.regions.far;
    const v = far.indexOf(Math.max(...far));
    if (far[v] > 0) this.add_site(v);
  }
  move_site(n, v) {
    this.chosen = n;
    if (v < 0 || this.sites[n] === v) return;
    this.sites[n] = v;
    this.changed();
  }
  remove_site(n) {
    if (this.sites.length <= 1) return;
    this.sites.splice(n, 1);
    this.chosen = Math.min(n, this.sites.length - 1);
    this.changed();
  }
  certify() {
    this.sites = certify(this.contour, this.sites);
    this.changed();
  }

  name(n) {
    const round = Math.floor(n / kLetters.length);
    return kLetters[n % kLetters.length] + (round > 0 ? round : '');
  }
  note(n) {
    const arcs = this.regions.arcs[n], count = arcs.reduce((sum, arc) => sum + arc.vertices.length, 0);
    const pieces = arcs.length > 1 ? `, in ${arcs.length} pieces` : '';
    return `${counted(count, 'vertex', 'vertices')} of T${pieces}`;
  }

  facets() { return facets_of(this.field, this.kappa, this.loops); }
  // The facet that the picture of insertion is about.
  facet(facets) {
    const off = (f) => distance(f.center, this.edge);
    return facets.reduce((best, f) => (this.edge ? off(f) < off(best) : f.h > best.h) ? f : best);
  }
  insert() {
    const facets = this.facets(), facet = this.facet(facets);
    const why_not = insert_surface_point(this.field, this.kappa, this.loops, facets, facet);
    if (why_not === '') ++this.by_hand;
    this.edge = null;
    this.said = why_not === '' ? 'Inserted. Now another edge is the worst.' : `Refused: ${why_not}.`;
  }
  // Stage 2 to its end; also on walks that are no mesh.
  finished(from = this.loops) {
    const loops = from.map((loop) => [...loop]);
    return { loops, ...refine(this.field, this.kappa, loops, this.limit, 0.1) };
  }
}
