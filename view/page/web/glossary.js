'use strict';
// Terms of docs/glossary.md in the page's words, with the short definitions that stand there. A term
// in a text becomes an element that shows its definition under the pointer or with the focus.

const kTerms = {
  'isosurface': 'all points where g is κ',
  'region of a site': 'the vertices of T with that label',
  'conflict zone': 'the tetrahedra whose circumspheres hold a new point',
  'Voronoi edge': 'the points whose three nearest sites are the corners of a facet; it is dual to the facet',
  'surface ball': 'the ball around the surface point through the corners of the facet',
  'surface point': 'the point nearest to the circumcenter where the dual line meets Σ and Σ faces as the facet does',
  'circumradius': 'the circumradius of a facet',
  'certificate': 'four conditions with which K has the topology of T',
  'cavity': 'the facets that an operation removes, a disk',
  'cone': 'the facets from a new vertex to the boundary of the cavity',
  'criterion': 'a bound on a measure of a facet',
  'facet': 'a triangle of the surface mesh',
  'gate': 'a validity test of an operation',
  'operation': 'what Stage 2 tries on a facet: insert, flip, collapse, move, split of a boundary edge, removal',
  'site': 'a point of S: a vertex of Stage 1',
  'switch': 'the step from Stage 1 to Stage 2: a plain mesh, without Del S',
};

const kTermPattern = new RegExp(`\\b(${Object.keys(kTerms).join('|')})s?\\b`, 'gi');

// Texts and elements: of every term the first place.
function with_terms(text) {
  const parts = [], seen = new Set();
  let from = 0;
  for (const match of text.matchAll(kTermPattern)) {
    const term = Object.keys(kTerms).find((name) => name.toLowerCase() === match[1].toLowerCase());
    if (seen.has(term)) continue;
    seen.add(term);
    parts.push(text.slice(from, match.index), element('span', { class: 'term', tabindex: 0,
      'aria-description': kTerms[term], 'data-term': term }, match[0]));
    from = match.index + match[0].length;
  }
  return [...parts, text.slice(from)];
}

function show_terms_of(root) {
  const entry = element('div', { class: 'term-entry', role: 'tooltip', hidden: true });
  document.body.append(entry);
  const show = ({ target }) => {
    const term = target.dataset?.term;
    entry.hidden = !term;
    if (!term) return;
    entry.replaceChildren(element('strong', {}, term), `: ${kTerms[term]}.`);
    const at = target.getBoundingClientRect();
    entry.style.left = `${clamp(at.left, 8, Math.max(8, innerWidth - entry.offsetWidth - 8))}px`;
    const below = at.bottom + 6;
    entry.style.top = `${below + entry.offsetHeight < innerHeight ? below : at.top - entry.offsetHeight - 6}px`;
  };
  root.addEventListener('mouseover', show);
  root.addEventListener('focusin', show);
  root.addEventListener('focusout', () => { entry.hidden = true; });
}
